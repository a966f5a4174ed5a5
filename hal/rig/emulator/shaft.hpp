#pragma once

#include <cstdint>

#include "hal/mujoco/encoder.hpp"
#include "hal/mujoco/table_params.hpp"
#include "hal/rig/boards/quadrature_inputs.hpp"

namespace twin::hal::rig::emulator {

/// The shaft of one motor as its encoder tells it: edges, and an index once a revolution, half a
/// revolution from where the shaft stood at power on.
class Shaft {
 public:
  /// @param position at power on, as travel [mm]
  Shaft(const mujoco::AxisParams& axis, double position) noexcept;

  /// The shaft is somewhere else now: what the encoder's wires did. Real-time safe.
  /// @param position as travel [mm]
  boards::EncoderMotion move_to(double position) noexcept;

 private:
  std::int64_t turn(double position) const noexcept;

  mujoco::Encoder encoder_;
  double lead_;    // [mm]
  double origin_;  // [mm]
  std::int64_t counts_;
  std::int64_t turn_ = 0;
};

}  // namespace twin::hal::rig::emulator

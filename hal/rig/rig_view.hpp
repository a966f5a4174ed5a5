#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/rig/cards.hpp"
#include "hal/rig/io_port/io_port.hpp"
#include "hal/rig/rig_settings.hpp"
#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {

/// What the cards show to somebody who only looks.
struct RigView {
  int board_id_1716 = -1;  ///< -1: the card does not answer
  int board_id_1784 = -1;
  std::array<std::int64_t, kServoAxes> counts{};         ///< counter of each axis, raw [counts]
  std::uint16_t digital = 0;                             ///< DI 0 to 15
  std::array<DriveInputs, kServoAxes> drives{};          ///< what they mean
  std::array<std::optional<double>, kServoAxes> vref{};  ///< read back [V]; empty: not wired
};

/// Looks at both cards beside whatever drives them: latches the counters, converts the analogue
/// inputs that read V-REF back, writes no output and no mode. The converters' own registers cannot
/// be read. Not real-time safe.
RigView look_at_rig(io_port::IoPort& pci1716, io_port::IoPort& pci1784,
                    const RigSettings& settings);

}  // namespace twin::hal::rig

#pragma once

#include "hal/mujoco/table_params.hpp"
#include "shadow/signal_row.hpp"

namespace twin::shadow {

/// The force of a motor against what the measured motion needs.
///
/// With the mass M, viscous and Coulomb friction and the weight w of the machine file,
///   residual = F - (M a + s2 v + Fc sgn(v) + w),
/// where measured position and F pass the same filter of second order,
///   x_f'' = omega^2 (x - x_f) - 2 omega x_f',
/// whose states are velocity and acceleration, so that neither is late against the other.
class ForceBalance {
 public:
  /// @param period  time between rows [s]
  ForceBalance(const hal::mujoco::AxisParams& params, double period) noexcept;

  /// Begins at a place at rest. Real-time safe.
  void begin(double measured, double force) noexcept;
  /// One period: measured position [mm], force of the motor at the slide [N]. Real-time safe.
  SignalRow step(double measured, double force) noexcept;

 private:
  struct Filtered {
    double value = 0.0;
    double rate = 0.0;
    double acceleration = 0.0;
  };
  void pass(double input, Filtered& state) const noexcept;

  hal::mujoco::AxisParams params_;
  double period_;  // [s]
  double omega_;   // [rad/s]
  Filtered place_;
  Filtered force_;
};

}  // namespace twin::shadow

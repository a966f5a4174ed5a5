#pragma once

#include "hal/mujoco/delay_line.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// The motor speed as the velocity loop of a drive sees it.
///
/// A digital drive reads its encoder once in a period P of the velocity loop, takes the difference
/// quotient of the last two angles, filters it with a time constant and works on it some time later:
///   w_k = (phi_k - phi_{k-1}) / P,   f_k = f_{k-1} + (1 - exp(-P / tau)) (w_k - f_{k-1}).
/// The difference quotient is the speed half a period ago, and it is held for a period. With P = 0
/// the loop is continuous and sees the true speed, behind filter and dead time where there are any.
class SpeedFeedback {
 public:
  /// @param drive  its velocity_loop_period P, speed_filter tau and speed_delay
  /// @param step   physics step, of which P becomes a whole number [s]. Allocates.
  SpeedFeedback(const DriveParams& drive, double step);

  /// Passes one physics step with a speed at its start. Real-time safe. @param speed  [rad/s]
  void step(double speed) noexcept;
  /// Whether the velocity loop works in the step that was passed last. Real-time safe.
  bool is_sample() const noexcept { return is_sample_; }
  /// The speed that the loop sees [rad/s]. Real-time safe.
  double speed() const noexcept { return seen_; }
  /// Time between two samples of the velocity loop [s].
  double period() const noexcept { return period_; }
  /// Makes the past one of a constant speed. Real-time safe.
  void reset(double speed = 0.0) noexcept;

 private:
  double step_;            // physics step [s]
  int steps_;              // physics steps in a sample of the loop
  double period_;          // P [s]
  double filter_share_;    // 1 - exp(-P / tau)
  DelayLine delay_;        // in samples
  int since_ = 0;          // physics steps since the last sample
  double turned_ = 0.0;    // phi_k - phi_{k-1} so far [rad]
  double filtered_ = 0.0;  // f [rad/s]
  double seen_ = 0.0;      // [rad/s]
  bool is_sample_ = true;
};

}  // namespace twin::hal::mujoco

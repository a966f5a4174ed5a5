#pragma once

#include <array>
#include <cstdint>

#include "hal/machine.hpp"
#include "interpolator/interpolator.hpp"
#include "servo/axis_servo.hpp"
#include "servo/gains.hpp"
#include "trace/sample.hpp"

namespace twin::runtime {

/// One interpolation period of the controller: the next set point, and its exchange with the
/// machine.
///
///   prepare()    interpolator -> set point of the coming period
///   exchange()   machine.read -> servo -> machine.write
///
/// The set point does not depend on what is measured, so it is prepared first; a period in which
/// none is there yet need not let time pass on a simulated machine. Nothing in either call
/// allocates, locks, throws, prints or touches a file.
class Cycle {
 public:
  /// @param machine  configured and active; null for a plan without a machine
  /// @param period   interpolation period T [s]
  Cycle(interpolator::Interpolator& interpolator, hal::Machine* machine,
        const std::array<servo::Gains, hal::kServoAxes>& gains, double period);

  /// Fetches the next set point; on anything but kMoving the last one stands. Real-time safe.
  interpolator::Status prepare() noexcept;
  /// Follows the set point for one period. Real-time safe.
  hal::Status exchange(trace::Sample& sample) noexcept;
  /// Follows the last set point, at rest, for one period. Real-time safe.
  hal::Status hold() noexcept;

 private:
  void set_reference(bool at_rest) noexcept;

  interpolator::Interpolator& interpolator_;
  hal::Machine* machine_;
  double period_;
  std::array<servo::AxisServo, hal::kServoAxes> servos_;
  hal::Inputs inputs_{};
  hal::Outputs outputs_{};
  interpolator::SetPoint set_point_{};
  Vec2 measured_ = Vec2::Zero();
  Vec2 table_ = Vec2::Zero();
  double prepare_time_ = 0.0;  // [s]
  double servo_time_ = 0.0;    // [s]
  std::int64_t periods_ = 0;
};

}  // namespace twin::runtime

#include "motion/servo/axis_servo.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace twin::motion {

AxisServo::AxisServo(const Gains& gains, double mm_per_s_per_volt, double period) noexcept
    : gains_(gains), mm_per_s_per_volt_(mm_per_s_per_volt), rate_(1.0 / period) {
  assert(period > 0.0 && mm_per_s_per_volt != 0.0);
}

double AxisServo::update(const Reference& reference, double measured) noexcept {
  const double error = reference.position - measured;
  const double error_rate = has_last_ ? (error - last_error_) * rate_ : 0.0;
  last_error_ = error;
  has_last_ = true;

  const double velocity = gains_.kp * error + gains_.kd * error_rate +
                          gains_.kf * reference.velocity + gains_.ka * reference.acceleration;
  const double volts = volts_from_velocity(velocity, mm_per_s_per_volt_) + gains_.trim_V;
  is_saturated_ = !(std::abs(volts) <= kMaxVolts);
  return std::isnan(volts) ? 0.0 : std::clamp(volts, -kMaxVolts, kMaxVolts);
}

void AxisServo::reset() noexcept {
  last_error_ = 0.0;
  has_last_ = false;
  is_saturated_ = false;
}

}  // namespace twin::motion

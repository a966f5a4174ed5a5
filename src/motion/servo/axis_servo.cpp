#include "motion/servo/axis_servo.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace twin::motion {

AxisServo::AxisServo(const Gains& gains, double mm_per_s_per_volt, double period) noexcept
    : gains_(gains), mm_per_s_per_volt_(mm_per_s_per_volt), rate_(1.0 / period) {
  assert(period > 0.0 && mm_per_s_per_volt != 0.0);
  const double periods =
      std::clamp(gains.command_delay * rate_, 0.0, static_cast<double>(kMostDelay - 2));
  delay_ = static_cast<std::size_t>(periods);
  delay_part_ = periods - static_cast<double>(delay_);
}

Reference AxisServo::delayed(const Reference& reference) noexcept {
  commands_[commands_seen_ % kMostDelay] = reference;
  const std::size_t known = commands_seen_++;
  const auto ago = [&](std::size_t periods) -> const Reference& {
    return commands_[(known - std::min(periods, known)) % kMostDelay];
  };
  const Reference& near = ago(delay_);
  const Reference& far = ago(delay_ + 1);
  const auto between = [this](double a, double b) { return a + delay_part_ * (b - a); };
  return {between(near.position, far.position), between(near.velocity, far.velocity),
          between(near.acceleration, far.acceleration)};
}

double AxisServo::measured_velocity(double measured) noexcept {
  const int periods = std::min(gains_.kv_periods, measured_seen_);
  const double velocity =
      periods > 0 ? (measured - measured_[static_cast<std::size_t>(periods - 1)]) * rate_ / periods
                  : 0.0;
  std::copy_backward(measured_.begin(), measured_.end() - 1, measured_.end());
  measured_.front() = measured;
  measured_seen_ = std::min(measured_seen_ + 1, kMostVelocityPeriods);
  return velocity;
}

double AxisServo::update(const Reference& set_point, double measured) noexcept {
  const Reference reference = gains_.command_delay > 0.0 ? delayed(set_point) : set_point;
  const double error = reference.position - measured;
  const double error_rate = has_last_ ? (error - last_error_) * rate_ : 0.0;
  last_error_ = error;
  has_last_ = true;

  double velocity = gains_.kp * error + gains_.kd * error_rate + gains_.kf * reference.velocity +
                    gains_.ka * reference.acceleration;
  if (gains_.kv != 0.0) {
    velocity -= gains_.kv * measured_velocity(measured);
  }
  const double volts = volts_from_velocity(velocity, mm_per_s_per_volt_) + gains_.trim_V;
  is_saturated_ = !(std::abs(volts) <= kMaxVolts);
  return std::isnan(volts) ? 0.0 : std::clamp(volts, -kMaxVolts, kMaxVolts);
}

void AxisServo::begin_moving(const Reference& reference, double measured,
                             double velocity) noexcept {
  reset();
  double late = reference.position;
  if (gains_.command_delay > 0.0) {
    for (std::size_t ago = kMostDelay; ago > 0; --ago) {
      Reference past = reference;
      past.position -= static_cast<double>(ago - 1) * reference.velocity / rate_;
      late = delayed(past).position;
    }
  }
  last_error_ = late - measured;
  has_last_ = true;
  for (int ago = kMostVelocityPeriods; ago > 0; --ago) {
    measured_velocity(measured - (ago - 1) * velocity / rate_);
  }
}

void AxisServo::reset() noexcept {
  last_error_ = 0.0;
  has_last_ = false;
  commands_seen_ = 0;
  measured_seen_ = 0;
  is_saturated_ = false;
}

}  // namespace twin::motion

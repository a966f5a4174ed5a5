#include "hal/mujoco/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace twin::hal::mujoco {
namespace {

constexpr double kRadPerSPerRpm = 2.0 * std::numbers::pi / 60.0;

/// What a first-order lag takes over of its input in one step: exact for a constant input.
double share_of_step(double step, double lag) noexcept {
  return lag > 0.0 ? -std::expm1(-step / lag) : 1.0;
}

}  // namespace

Drive::Drive(const DriveParams& drive, const MotorParams& motor, double inertia, double step,
             double torque_per_volt)
    : drive_(drive),
      motor_(motor),
      full_gain_(inertia * 2.0 * std::numbers::pi * drive.velocity_gain_Hz),
      gain_(full_gain_),
      step_(step),
      torque_per_volt_(torque_per_volt),
      feedback_(drive, step),
      input_share_(share_of_step(step, drive.input_lag)),
      current_share_(share_of_step(step, motor.current_lag)) {}

void Drive::reset() noexcept {
  filtered_ = integral_ = torque_ = current_ = time_on_ = time_limited_ = 0.0;
  feedback_.reset();
  is_ready_ = has_alarm_ = false;
}

void Drive::set_loop_gain(double factor) noexcept {
  const double gain = full_gain_ * factor;
  if (gain != gain_) {
    integral_ *= gain_ / gain;
    gain_ = gain;
  }
}

void Drive::begin_moving(double volts, double speed, double torque) noexcept {
  reset();
  time_on_ = 2.0 * drive_.ready_delay + step_;
  filtered_ = volts + drive_.vref_offset;
  feedback_.reset(speed);
  torque_ = torque;
  current_ = torque / motor_.torque_constant;
  if (drive_.mode == DriveMode::kSpeed && drive_.integral_time > 0.0) {
    integral_ = torque / gain_ - (speed_reference({}) - speed);
  }
}

void Drive::filter_reference(double volts, double time) noexcept {
  double disturbed = volts + drive_.vref_offset;
  if (drive_.hum_amplitude != 0.0) {
    const double angle = 2.0 * std::numbers::pi * drive_.hum_frequency_Hz * time + drive_.hum_phase;
    disturbed += drive_.hum_amplitude * std::sin(angle);
  }
  filtered_ += input_share_ * (disturbed - filtered_);
}

double Drive::speed_reference(const DriveSignals& signals) const noexcept {
  double speed = filtered_ * drive_.vref_scale_rpm_per_V * kRadPerSPerRpm;
  if (signals.limit_positive) {
    speed = std::min(speed, 0.0);
  }
  if (signals.limit_negative) {
    speed = std::max(speed, 0.0);
  }
  return speed;
}

double Drive::limited(double wanted) noexcept {
  const double torque = std::clamp(wanted, -motor_.peak_torque, motor_.peak_torque);
  watch_overload(torque != wanted);
  return torque;
}

double Drive::velocity_loop(double error) noexcept {
  const double wanted = gain_ * (error + integral_);
  const double torque = limited(wanted);
  const bool is_limited = torque != wanted;
  if (drive_.integral_time > 0.0 && (!is_limited || wanted * error < 0.0)) {
    integral_ += error * feedback_.period() / drive_.integral_time;
  }
  return torque;
}

double Drive::wanted_torque(double speed, const DriveSignals& signals) noexcept {
  if (drive_.mode == DriveMode::kTorque) {
    const double torque = filtered_ * torque_per_volt_;
    const bool is_outward =
        (signals.limit_positive && torque > 0.0) || (signals.limit_negative && torque < 0.0);
    return limited(is_outward ? 0.0 : torque);
  }
  feedback_.step(speed);
  if (feedback_.is_sample()) {
    torque_ = velocity_loop(speed_reference(signals) - feedback_.speed());
  }
  return torque_;
}

void Drive::watch_overload(bool is_limited) noexcept {
  const double passed = drive_.mode == DriveMode::kSpeed ? feedback_.period() : step_;
  time_limited_ = is_limited ? time_limited_ + passed : 0.0;
  if (time_limited_ >= drive_.overload_time) {
    has_alarm_ = true;
  }
}

double Drive::step(double volts, double speed, double time, const DriveSignals& signals) noexcept {
  filter_reference(volts, time);
  time_on_ = signals.servo_on ? time_on_ + step_ : 0.0;
  is_ready_ = signals.servo_on && !has_alarm_ && time_on_ > drive_.ready_delay;
  if (!is_ready_) {
    integral_ = torque_ = current_ = time_limited_ = 0.0;
    feedback_.reset(speed);
    return 0.0;
  }
  const double torque = wanted_torque(speed, signals);
  current_ += current_share_ * (torque / motor_.torque_constant - current_);
  return motor_.torque_constant * current_;
}

}  // namespace twin::hal::mujoco

#include "studies/identify/axis_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/units.hpp"
#include "hal/mujoco/screw.hpp"
#include "hal/mujoco/table_settings.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kFarAway = 1e5;  // beyond any machine; counts stay inside an integer [mm]

hal::mujoco::AxisParams without_hum(hal::mujoco::AxisParams params) {
  params.drive.hum_amplitude = 0.0;
  return params;
}

/// Physics step that divides the period [s].
double step_of(const AxisSetup& setup) {
  return setup.period / hal::mujoco::steps_per_period(setup.period, setup.physics_step);
}

}  // namespace

AxisSetup axis_setup(const config::MachineFile& machine, hal::Axis axis) {
  return {machine.table.axis[axis], machine.servo[axis], machine.period, machine.table.physics_step,
          machine.table.has_giving_screws()};
}

AxisModel::AxisModel(const AxisSetup& setup, double start)
    : params_(setup.axis),
      dac_(setup.axis.dac_bits),
      axis_(without_hum(setup.axis), step_of(setup)),
      hum_(setup.axis.drive.hum_amplitude,
           2.0 * std::numbers::pi * setup.axis.drive.hum_frequency_Hz * step_of(setup),
           setup.axis.drive.hum_phase),
      encoder_(setup.axis.encoder),
      servo_(setup.servo, setup.axis.mm_per_s_per_volt(), setup.period),
      mm_per_count_(setup.axis.encoder.mm_per_count),
      rad_per_mm_(1.0 / setup.axis.mm_per_rad()),
      force_per_torque_(1.0 / units::m_from_mm(setup.axis.mm_per_rad())),
      rate_per_force_(0.0),
      step_(0.0),
      steps_(hal::mujoco::steps_per_period(setup.period, setup.physics_step)),
      period_(setup.period),
      feedback_(setup.axis.encoder.delay * steps_ / setup.period),
      reported_(start),
      position_(start),
      has_screw_(setup.has_screw),
      slide_rate_(0.0),
      motor_rate_(0.0),
      motor_position_(start) {
  feedback_.fill(start);
  step_ = setup.period / steps_;
  rate_per_force_ = units::mm_from_m(step_ / (setup.axis.moving_mass + setup.axis.rotor_mass()));
  slide_rate_ = units::mm_from_m(step_ / setup.axis.moving_mass);
  motor_rate_ = units::mm_from_m(step_ / setup.axis.rotor_mass());
}

void AxisModel::advance() noexcept {
  if (has_failed_) {
    return;
  }
  for (int i = 0; i < steps_; ++i) {
    if (!hum_.is_zero()) {
      hal::mujoco::AxisCondition disturbed;
      disturbed.vref_offset = hum_.next();
      axis_.set_condition(disturbed);
    }
    if (has_screw_) {
      step_with_screw();
    } else {
      step_rigid();
    }
    reported_ = feedback_.step(measured_place());
  }
  if (!(std::abs(position_) < kFarAway && std::abs(motor_position_) < kFarAway)) {
    has_failed_ = true;
    position_ = velocity_ = reported_ = motor_position_ = motor_velocity_ = 0.0;
  }
}

void AxisModel::step_rigid() noexcept {
  const hal::mujoco::AxisForces forces =
      axis_.step({position_, velocity_, velocity_ * rad_per_mm_}, 0.0);
  velocity_ += rate_per_force_ * (forces.slide + forces.torque * force_per_torque_);
  position_ += step_ * velocity_;
  force_ = forces.torque * force_per_torque_;
}

void AxisModel::step_with_screw() noexcept {
  const hal::mujoco::AxisForces forces =
      axis_.step({position_, velocity_, motor_velocity_ * rad_per_mm_}, 0.0);
  const hal::mujoco::ScrewParams& screw = params_.screw;
  const double pull =
      hal::mujoco::screw_force({position_ - motor_position_, velocity_ - motor_velocity_},
                               screw.stiffness, screw.damping, screw.backlash);
  force_ = forces.torque * force_per_torque_;
  velocity_ += slide_rate_ * (forces.slide - pull);
  motor_velocity_ += motor_rate_ * (force_ + pull);
  position_ += step_ * velocity_;
  motor_position_ += step_ * motor_velocity_;
}

double AxisModel::measured_place() const noexcept {
  const bool is_at_motor = params_.encoder.place == hal::mujoco::EncoderPlace::kMotor;
  return has_screw_ && is_at_motor ? motor_position_ : position_;
}

void AxisModel::write(double volts) noexcept {
  if (std::isfinite(volts)) {
    axis_.command(dac_.convert(volts), true);
  }
}

AxisRow AxisModel::row() const noexcept {
  AxisRow row;
  row.table = position_;
  row.feedback = reported_;
  row.encoder = motion::position_from_counts(encoder_.counts(reported_), mm_per_count_);
  row.force = force_;
  return row;
}

AxisRow AxisModel::follow(const motion::Reference& reference) noexcept {
  advance();
  AxisRow row = this->row();
  row.volts = servo_.update(reference, row.encoder);
  write(row.volts);
  return row;
}

AxisRow AxisModel::drive(double volts) noexcept {
  advance();
  AxisRow row = this->row();
  row.volts = volts;
  write(volts);
  return row;
}

void AxisModel::begin_moving(const BeginOfMotion& begin) noexcept {
  const double measured = begin.position - begin.velocity * period_;
  position_ = motor_position_ = measured;
  velocity_ = motor_velocity_ = begin.velocity;
  feedback_.fill(measured);
  reported_ = measured;
  const double sliding = std::copysign(params_.friction.coulomb_at(velocity_), velocity_) +
                         params_.friction.viscous_at(velocity_) * velocity_ + params_.load.weight;
  const double of_slide = sliding + params_.moving_mass * units::m_from_mm(begin.acceleration);
  if (has_screw_) {
    const hal::mujoco::ScrewParams& screw = params_.screw;
    const double stretch =
        of_slide / screw.stiffness + std::copysign(0.5 * screw.backlash, of_slide);
    const bool is_at_motor = params_.encoder.place == hal::mujoco::EncoderPlace::kMotor;
    (is_at_motor ? position_ : motor_position_) += is_at_motor ? -stretch : stretch;
  }
  const double mass = params_.moving_mass + params_.rotor_mass();
  force_ = sliding + mass * units::m_from_mm(begin.acceleration);
  const double torque = force_ / force_per_torque_;
  const bool is_torque_mode = params_.drive.mode == hal::mujoco::DriveMode::kTorque;
  const double steady =
      is_torque_mode ? torque / params_.torque_per_volt() : velocity_ / params_.mm_per_s_per_volt();
  axis_.begin_moving({position_, velocity_, velocity_ * rad_per_mm_},
                     std::isfinite(begin.volts) ? begin.volts : steady, torque);
  motion::Reference past = begin.command;
  past.position -= begin.velocity * period_;
  servo_.begin_moving(past, measured, begin.velocity);
}

void AxisModel::settle(double position) noexcept {
  const double period = step_ * steps_;
  const long periods = std::lround(kSettleTime / period);
  for (long i = 0; i < periods; ++i) {
    follow({position, 0.0, 0.0});
  }
}

AxisRun simulate(const AxisSetup& setup, std::span<const motion::Reference> set_points) {
  AxisRun run;
  if (set_points.empty()) {
    return run;
  }
  run.rows.reserve(set_points.size());
  AxisModel model(setup, set_points.front().position);
  model.settle(set_points.front().position);
  for (const motion::Reference& set_point : set_points) {
    run.rows.push_back(model.follow(set_point));
  }
  run.has_failed = model.has_failed();
  return run;
}

AxisRun simulate_moving(const AxisSetup& setup, std::span<const motion::Reference> set_points,
                        const BeginOfMotion& begin) {
  AxisRun run;
  run.rows.reserve(set_points.size());
  AxisModel model(setup, begin.position);
  model.begin_moving(begin);
  for (const motion::Reference& set_point : set_points) {
    run.rows.push_back(model.follow(set_point));
  }
  run.has_failed = model.has_failed();
  return run;
}

std::vector<motion::Reference> differentiate(std::span<const double> positions, double period) {
  std::vector<motion::Reference> result(positions.size());
  const std::size_t count = positions.size();
  const auto at = [&](std::size_t k, std::ptrdiff_t offset) {
    const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(k) + offset;
    return positions[static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(place, 0, static_cast<std::ptrdiff_t>(count) - 1))];
  };
  for (std::size_t k = 0; k < count; ++k) {
    const double near = at(k, 1) - at(k, -1);
    const double far = at(k, 2) - at(k, -2);
    result[k] = {positions[k], (8.0 * near - far) / (12.0 * period),
                 (at(k, 1) - 2.0 * positions[k] + at(k, -1)) / (period * period)};
  }
  return result;
}

}  // namespace twin::studies::identify

#include "studies/identify/axis_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/units.hpp"
#include "hal/mujoco/table_settings.hpp"
#include "motion/servo/axis_servo.hpp"

namespace twin::studies::identify {
namespace {

constexpr double kFarAway = 1e5;  // beyond any machine; counts stay inside an integer [mm]

}  // namespace

AxisSetup axis_setup(const config::MachineFile& machine, hal::Axis axis) {
  return {machine.table.axis[axis], machine.servo[axis], machine.period,
          machine.table.physics_step};
}

AxisModel::AxisModel(const AxisSetup& setup, double start)
    : params_(setup.axis),
      dac_(setup.axis.dac_bits),
      axis_(setup.axis,
            setup.period / hal::mujoco::steps_per_period(setup.period, setup.physics_step)),
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
      position_(start) {
  feedback_.fill(start);
  step_ = setup.period / steps_;
  rate_per_force_ = units::mm_from_m(step_ / (setup.axis.moving_mass + setup.axis.rotor_mass()));
}

void AxisModel::advance() noexcept {
  if (has_failed_) {
    return;
  }
  for (int i = 0; i < steps_; ++i) {
    const double time = static_cast<double>(steps_done_++) * step_;
    const hal::mujoco::AxisForces forces =
        axis_.step({position_, velocity_, velocity_ * rad_per_mm_}, time);
    velocity_ += rate_per_force_ * (forces.slide + forces.torque * force_per_torque_);
    position_ += step_ * velocity_;
    force_ = forces.torque * force_per_torque_;
    reported_ = feedback_.step(position_);
  }
  if (!(std::abs(position_) < kFarAway)) {
    has_failed_ = true;
    position_ = velocity_ = reported_ = 0.0;
  }
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
  position_ = begin.position - begin.velocity * period_;
  velocity_ = begin.velocity;
  feedback_.fill(position_);
  reported_ = position_;
  const double sliding = std::copysign(params_.friction.coulomb_at(velocity_), velocity_) +
                         params_.friction.viscous_at(velocity_) * velocity_ + params_.load.weight;
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
  servo_.begin_moving(past, position_, begin.velocity);
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

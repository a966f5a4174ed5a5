#include "shadow/driven_axis.hpp"

#include <cmath>

#include "core/units.hpp"
#include "hal/mujoco/screw.hpp"
#include "hal/mujoco/table_settings.hpp"

namespace twin::shadow {
namespace {

using hal::mujoco::AxisParams;

/// Travel without end stops and limit switches [mm].
constexpr double kEndless = 1e12;
/// Largest (omega h)^2 of the screw's oscillation; the explicit step is stable up to 4.
constexpr double kLargestStiffness = 1.0;

AxisParams without_ends(AxisParams params) {
  params.travel = kEndless;
  params.drive.hum_amplitude = 0.0;
  return params;
}

}  // namespace

bool DrivenAxis::can_give(const AxisParams& params, double period, double physics_step) noexcept {
  const double step = period / hal::mujoco::steps_per_period(period, physics_step);
  const double inverse = 1.0 / params.rotor_mass() + 1.0 / params.moving_mass;
  const double spring = units::mm_from_m(params.screw.stiffness) * inverse * step * step;
  const double damper = units::mm_from_m(params.screw.damping) * inverse * step;
  return spring < kLargestStiffness && damper < kLargestStiffness;
}

DrivenAxis::DrivenAxis(const AxisParams& params, double period, double physics_step,
                       ScrewModel screw, const hal::mujoco::AxisCondition& condition)
    : params_(without_ends(params)),
      condition_(condition),
      screw_(screw),
      dac_(params.dac_bits),
      steps_(hal::mujoco::steps_per_period(period, physics_step)),
      step_(period / steps_),
      axis_(params_, step_),
      feedback_(params.encoder.delay / step_),
      rad_per_mm_(1.0 / params.mm_per_rad()),
      force_per_torque_(1.0 / units::m_from_mm(params.mm_per_rad())) {
  axis_.set_condition(condition);
  const double slide = params.moving_mass + condition.mass;
  const double motor = params.rotor_mass();
  const double of_slide = screw == ScrewModel::kRigid ? slide + motor : slide;
  slide_rate_ = units::mm_from_m(step_ / of_slide);
  motor_rate_ = units::mm_from_m(step_ / motor);
}

void DrivenAxis::begin(double position, double volts) noexcept {
  const bool is_speed = params_.drive.mode == hal::mujoco::DriveMode::kSpeed;
  const double velocity =
      is_speed ? params_.mm_per_s_per_volt() * (volts + params_.drive.vref_offset) : 0.0;
  place_of_motor_ = place_of_slide_ = reported_ = position;
  motor_velocity_ = slide_velocity_ = velocity;
  feedback_.fill(position);
  const hal::mujoco::FrictionParams& friction = params_.friction;
  const double sliding = velocity == 0.0 ? 0.0
                                         : std::copysign(friction.coulomb_at(velocity), velocity) +
                                               friction.viscous_at(velocity) * velocity;
  const double force = sliding + params_.load.weight;
  volts_ = dac_.convert(volts);
  axis_.begin_moving({position, velocity, velocity * rad_per_mm_}, volts_,
                     force / force_per_torque_);
  axis_.set_condition(condition_);
}

void DrivenAxis::command(double volts) noexcept {
  if (std::isfinite(volts)) {
    volts_ = dac_.convert(volts);
    axis_.command(volts_, true);
  }
}

void DrivenAxis::step_rigid(double place) noexcept {
  const hal::mujoco::AxisForces forces =
      axis_.step({place, motor_velocity_, motor_velocity_ * rad_per_mm_}, 0.0);
  motor_velocity_ += slide_rate_ * (forces.slide + forces.torque * force_per_torque_);
  place_of_motor_ += step_ * motor_velocity_;
}

void DrivenAxis::step_with_screw(double place) noexcept {
  const hal::mujoco::AxisForces forces =
      axis_.step({place, slide_velocity_, motor_velocity_ * rad_per_mm_}, 0.0);
  const double pull = hal::mujoco::screw_force(
      {place_of_slide_ - place_of_motor_, slide_velocity_ - motor_velocity_},
      params_.screw.stiffness * condition_.stiffness, params_.screw.damping,
      params_.screw.backlash + condition_.backlash);
  slide_velocity_ += slide_rate_ * (forces.slide - pull);
  motor_velocity_ += motor_rate_ * (forces.torque * force_per_torque_ + pull);
  place_of_slide_ += step_ * slide_velocity_;
  place_of_motor_ += step_ * motor_velocity_;
}

void DrivenAxis::advance(double place, std::span<const double> hum) noexcept {
  for (int i = 0; i < steps_; ++i) {
    if (!hum.empty()) {
      axis_.command(volts_ + hum[static_cast<std::size_t>(i)], true);
    }
    if (screw_ == ScrewModel::kRigid) {
      step_rigid(place);
    } else {
      step_with_screw(place);
    }
    reported_ = feedback_.step(
        params_.encoder.place == hal::mujoco::EncoderPlace::kTable ? slide() : place_of_motor_);
  }
}

bool DrivenAxis::has_failed() const noexcept {
  return !(std::abs(place_of_motor_) < 1e9) || !(std::abs(motor_velocity_) < 1e9);
}

}  // namespace twin::shadow

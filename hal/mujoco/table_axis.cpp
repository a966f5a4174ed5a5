#include "hal/mujoco/table_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace twin::hal::mujoco {
namespace {

// Rubber end stops behind the limit switches: only so that a runaway ends somewhere.
constexpr double kStopGap = 5.0;           // behind the switch [mm]
constexpr double kStopStiffness = 1000.0;  // [N/mm]
constexpr double kStopDamping = 5.0;       // [N s/mm]

}  // namespace

TableAxis::TableAxis(const AxisParams& params, double step)
    : travel_(params.travel),
      delay_(params.drive.output_delay / step),
      drive_(params.drive, params.motor, params.total_inertia(), step, params.torque_per_volt()),
      friction_(params.friction, step),
      load_(params.load),
      ripple_per_mm_(2.0 * std::numbers::pi * params.load.ripple_per_revolution /
                     params.screw.lead) {}

void TableAxis::command(double volts, bool servo_on) noexcept {
  volts_ = volts;
  servo_on_ = servo_on;
}

double TableAxis::end_stop(const AxisMotion& motion) const noexcept {
  const double depth = std::abs(motion.position) - (travel_ + kStopGap);
  if (depth <= 0.0) {
    return 0.0;
  }
  const double outward = std::copysign(1.0, motion.position);
  const double push = kStopStiffness * depth + kStopDamping * outward * motion.velocity;
  return -outward * std::max(push, 0.0);
}

double TableAxis::load(double position) const noexcept {
  if (load_.ripple_amplitude == 0.0) {
    return -load_.weight;
  }
  return load_.ripple_amplitude * std::sin(ripple_per_mm_ * position + load_.ripple_phase) -
         load_.weight;
}

void TableAxis::begin_moving(const AxisMotion& motion, double volts, double torque) noexcept {
  command(volts, true);
  delay_.fill(volts);
  drive_.begin_moving(volts, motion.motor_speed, torque);
  friction_.reset(motion.velocity);
}

AxisForces TableAxis::step(const AxisMotion& motion, double time) noexcept {
  DriveSignals signals;
  signals.servo_on = servo_on_;
  signals.limit_positive = is_limit_positive(motion.position);
  signals.limit_negative = is_limit_negative(motion.position);
  AxisForces forces;
  const double volts = delay_.step(volts_) * condition_.vref_gain + condition_.vref_offset;
  forces.torque = drive_.step(volts, motion.motor_speed, time, signals);
  resistance_ = friction_.step(motion.velocity) * condition_.friction;
  forces.slide = end_stop(motion) - resistance_ + load(motion.position) + condition_.force;
  torque_ = forces.torque;
  return forces;
}

void TableAxis::reset_drive() noexcept {
  switch_off();
  delay_.clear();
  drive_.reset();
}

}  // namespace twin::hal::mujoco

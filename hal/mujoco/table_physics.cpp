#include "hal/mujoco/table_physics.hpp"

#include <numbers>
#include <utility>

#include "core/units.hpp"
#include "hal/mujoco/screw.hpp"

namespace twin::hal::mujoco {
namespace {

constexpr int kPassiveForces =
#if mjVERSION_HEADER >= 336
    mjDSBL_SPRING | mjDSBL_DAMPER;
#else
    mjDSBL_PASSIVE;
#endif

/// Switches off what no model of the table needs, whatever its file says.
void strip_options(mjModel& model, double step) noexcept {
  model.opt.timestep = step;
  model.opt.integrator = mjINT_EULER;
  model.opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_EQUALITY |
                            mjDSBL_FRICTIONLOSS | mjDSBL_GRAVITY | mjDSBL_ACTUATION |
                            mjDSBL_SENSOR | mjDSBL_WARMSTART;
  if (model.ntendon == 0) {
    model.opt.disableflags |= kPassiveForces;  // nothing springs but the screws
  }
  model.opt.enableflags = 0;
}

}  // namespace

Expected<std::unique_ptr<TablePhysics>> TablePhysics::open(const TableParams& params, double step) {
  auto in_file = [&params](Error error) {
    error.file = params.model;
    return error;
  };
  TWIN_TRY(ModelPtr model, load_model(params.model));
  TWIN_TRY(const TableJoints joints, find_table_joints(*model).map_error(in_file));
  TWIN_TRY(DataPtr data, make_data(*model).map_error(in_file));
  strip_options(*model, step);
  TWIN_CHECK(apply_params(*model, *data, joints, params));
  MujocoLibrary::loaded().reset_data(model.get(), data.get());
  return std::unique_ptr<TablePhysics>(
      new TablePhysics(std::move(model), std::move(data), joints, params));
}

TablePhysics::TablePhysics(ModelPtr model, DataPtr data, const TableJoints& joints,
                           const TableParams& params)
    : model_(std::move(model)),
      data_(std::move(data)),
      joints_(joints),
      mm_per_rad_{params.axis[kX].mm_per_rad(), params.axis[kY].mm_per_rad()},
      pen_omega_(2.0 * std::numbers::pi * params.pen_bandwidth_Hz),
      screws_{params.axis[kX].screw, params.axis[kY].screw},
      encoder_at_{params.axis[kX].encoder.place, params.axis[kY].encoder.place} {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    if (screws_[axis].backlash > 0.0) {
      set_condition(axis, {});
    }
  }
}

AxisMotion TablePhysics::motion(std::size_t axis) const noexcept {
  const AxisJoints& joints = joints_.axis[axis];
  AxisMotion motion;
  motion.position = units::mm_from_m(data_->qpos[joints.slide.qpos]);
  motion.velocity = units::mm_from_m(data_->qvel[joints.slide.dof]);
  motion.motor_speed =
      joints.is_compliant() ? data_->qvel[joints.motor.dof] : motion.velocity / mm_per_rad_[axis];
  return motion;
}

double TablePhysics::motor_position(std::size_t axis) const noexcept {
  const AxisJoints& joints = joints_.axis[axis];
  return joints.is_compliant() ? data_->qpos[joints.motor.qpos] * mm_per_rad_[axis]
                               : units::mm_from_m(data_->qpos[joints.slide.qpos]);
}

double TablePhysics::encoder_position(std::size_t axis) const noexcept {
  return encoder_at_[axis] == EncoderPlace::kMotor
             ? motor_position(axis)
             : units::mm_from_m(data_->qpos[joints_.axis[axis].slide.qpos]);
}

double TablePhysics::pen_position() const noexcept {
  return units::mm_from_m(data_->qpos[joints_.pen.qpos]);
}

void TablePhysics::set_condition(std::size_t axis, const AxisCondition& condition) noexcept {
  const AxisJoints& joints = joints_.axis[axis];
  Screw& changed = changed_[axis];
  changed.stiffness = screws_[axis].stiffness * condition.stiffness;
  changed.damping = screws_[axis].damping;
  changed.backlash = screws_[axis].backlash + condition.backlash;
  changed.mass = condition.mass;
  if (joints.is_compliant() && !changed.is_ours) {
    changed.is_ours = true;
    model_->tendon_stiffness[joints.screw] = 0.0;
    model_->tendon_damping[joints.screw] = 0.0;
  }
}

double TablePhysics::screw_force(std::size_t axis) const noexcept {
  const Screw& screw = changed_[axis];
  const AxisMotion at = motion(axis);
  return mujoco::screw_force(
      {at.position - motor_position(axis), at.velocity - at.motor_speed * mm_per_rad_[axis]},
      screw.stiffness, screw.damping, screw.backlash);
}

void TablePhysics::apply(std::size_t axis, const AxisForces& forces) noexcept {
  const AxisJoints& joints = joints_.axis[axis];
  if (joints.is_compliant()) {
    data_->qfrc_applied[joints.motor.dof] = forces.torque;
    data_->qfrc_applied[joints.slide.dof] = forces.slide;
  } else {
    data_->qfrc_applied[joints.slide.dof] =
        forces.slide + forces.torque / units::m_from_mm(mm_per_rad_[axis]);
  }
  if (changed_[axis].is_ours) {
    const double pull = screw_force(axis);
    data_->qfrc_applied[joints.slide.dof] -= pull;
    data_->qfrc_applied[joints.motor.dof] += pull * units::m_from_mm(mm_per_rad_[axis]);
  }
  if (changed_[axis].mass != 0.0) {
    // The inertial force of the added mass, with the acceleration of the last step.
    data_->qfrc_applied[joints.slide.dof] -= changed_[axis].mass * data_->qacc[joints.slide.dof];
  }
}

void TablePhysics::pull_pen(double reference) noexcept {
  const double error = units::m_from_mm(reference) - data_->qpos[joints_.pen.qpos];
  const double velocity = data_->qvel[joints_.pen.dof];
  data_->qfrc_applied[joints_.pen.dof] =
      model_->body_mass[joints_.pen.body] * pen_omega_ * (pen_omega_ * error - 2.0 * velocity);
}

void TablePhysics::step() { mujoco_.step(model_.get(), data_.get()); }

bool TablePhysics::is_unstable() const noexcept {
  const mjWarningStat* warning = data_->warning;
  return warning[mjWARN_BADQPOS].number > 0 || warning[mjWARN_BADQVEL].number > 0 ||
         warning[mjWARN_BADQACC].number > 0 || warning[mjWARN_INERTIA].number > 0;
}

}  // namespace twin::hal::mujoco

#include "hal/mujoco/mujoco_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/units.hpp"
#include "hal/mujoco/model.hpp"
#include "hal/mujoco/mujoco_errors.hpp"
#include "hal/mujoco/table_joints.hpp"
#include "hal/mujoco/table_settings.hpp"

namespace twin::hal {

struct MujocoMachine::Physics {
  ModelPtr model;
  DataPtr data;
  TableJoints joints;

  double position(const SlideJoint& joint) const {
    return units::mm_from_m(data->qpos[joint.qpos]);
  }
  double velocity(const SlideJoint& joint) const { return units::mm_from_m(data->qvel[joint.dof]); }
};

namespace {

/// MuJoCo resets the state by itself when a number goes bad, and only counts that.
bool is_unstable(const mjData& data) noexcept {
  return data.warning[mjWARN_BADQPOS].number > 0 || data.warning[mjWARN_BADQVEL].number > 0 ||
         data.warning[mjWARN_BADQACC].number > 0 || data.warning[mjWARN_INERTIA].number > 0;
}

/// What no model of the table needs, whatever its file says.
void strip_options(mjModel& model, double step) noexcept {
  model.opt.timestep = step;
  model.opt.integrator = mjINT_EULER;
  model.opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_EQUALITY |
                            mjDSBL_FRICTIONLOSS | mjDSBL_GRAVITY | mjDSBL_ACTUATION |
                            mjDSBL_SENSOR | mjDSBL_WARMSTART;
  model.opt.enableflags = 0;
}

/// Force that makes the pen slide a critically damped follower of its reference [N].
double pen_force(double mass, double bandwidth_Hz, double error_m,
                 double velocity_m_per_s) noexcept {
  const double omega = 2.0 * std::numbers::pi * bandwidth_Hz;
  return mass * omega * (omega * error_m - 2.0 * velocity_m_per_s);
}

}  // namespace

MujocoMachine::MujocoMachine(TableParams params) : params_(std::move(params)) {
  info_.name = "mujoco";
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisParams& p = params_.axis[axis];
    info_.mm_per_count[axis] = p.encoder.mm_per_count;
    info_.mm_per_s_per_volt[axis] = p.drive.vref_scale_rpm_per_V / 60.0 * p.screw.lead;
  }
}

MujocoMachine::~MujocoMachine() = default;

Expected<void> MujocoMachine::configure(double period) {
  if (state_ == State::kActive) {
    return fail(ErrorCode::kMachine, "the table is active; deactivate it before configure");
  }
  cleanup();
  if (Expected<void> valid = validate(params_, period); !valid) {
    return valid;
  }
  const int steps = steps_per_period(period, params_.physics_step);
  auto in_model_file = [this](Error error) {
    error.file = params_.model;
    return tl::unexpected<Error>(std::move(error));
  };
  Expected<ModelPtr> model = load_model(params_.model);
  if (!model) {
    return tl::unexpected<Error>(model.error());
  }
  const Expected<TableJoints> joints = find_table_joints(**model);
  if (!joints) {
    return in_model_file(joints.error());
  }
  Expected<DataPtr> data = make_data(**model);
  if (!data) {
    return in_model_file(data.error());
  }
  strip_options(**model, period / steps);
  if (Expected<void> applied = apply_params(**model, **data, *joints, params_); !applied) {
    return applied;
  }
  mj_resetData(model->get(), data->get());
  physics_ = std::make_unique<Physics>(Physics{std::move(*model), std::move(*data), *joints});
  steps_ = steps;
  step_ = period / steps;
  steps_done_ = 0;
  origin_.fill(0.0);
  pen_reference_ = 0.0;
  for (const AxisParams& axis : params_.axis) {
    axes_.emplace_back(axis, step_);
  }
  state_ = State::kInactive;
  return {};
}

Expected<void> MujocoMachine::activate() {
  if (state_ != State::kInactive) {
    return fail(ErrorCode::kMachine, state_ == State::kActive ? "the table is active already"
                                                              : "the table is not configured");
  }
  if (fault_ == Fault::kUnstable || fault_ == Fault::kMujoco) {
    return fail(ErrorCode::kMachine, "the table must be configured again: " + last_error());
  }
  fault_ = Fault::kNone;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    axes_[axis].reset_drive();
    axes_[axis].encoder().zero(encoder_position(axis));
    origin_[axis] = physics_->position(physics_->joints.axis[axis].slide);
  }
  state_ = State::kActive;
  return {};
}

void MujocoMachine::apply_forces() noexcept {
  mjData& data = *physics_->data;
  const double time = static_cast<double>(steps_done_) * step_;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisJoints& joints = physics_->joints.axis[axis];
    const double mm_per_rad = params_.axis[axis].mm_per_rad();
    AxisMotion motion;
    motion.position = physics_->position(joints.slide);
    motion.velocity = physics_->velocity(joints.slide);
    motion.motor_speed =
        joints.is_compliant() ? data.qvel[joints.motor.dof] : motion.velocity / mm_per_rad;
    const AxisForces forces = axes_[axis].step(motion, time);
    // qfrc_applied stays until it is overwritten, so every entry is written in every step.
    double on_slide = forces.slide + external_force_[axis];
    if (joints.is_compliant()) {
      data.qfrc_applied[joints.motor.dof] = forces.torque;
    } else {
      on_slide += forces.torque / units::m_from_mm(mm_per_rad);
    }
    data.qfrc_applied[joints.slide.dof] = on_slide;
  }
  const SlideJoint& pen = physics_->joints.pen;
  data.qfrc_applied[pen.dof] =
      pen_force(physics_->model->body_mass[pen.body], params_.pen_bandwidth_Hz,
                units::m_from_mm(pen_reference_) - data.qpos[pen.qpos], data.qvel[pen.dof]);
}

bool MujocoMachine::advance() noexcept {
  try {
    for (int i = 0; i < steps_; ++i) {
      apply_forces();
      mj_step(physics_->model.get(), physics_->data.get());
      ++steps_done_;
    }
    return true;
  } catch (const std::exception& error) {
    const std::string_view text = error.what();
    fault_text_.fill('\0');
    std::copy_n(text.begin(), std::min(text.size(), fault_text_.size() - 1), fault_text_.begin());
    return false;
  }
}

Status MujocoMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    return stop_with(Fault::kNotConfigured);
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  if (!advance()) {
    return stop_with(Fault::kMujoco);
  }
  if (is_unstable(*physics_->data)) {
    return stop_with(Fault::kUnstable);
  }
  fill(inputs);
  return Status::kOk;
}

void MujocoMachine::fill(Inputs& inputs) const noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const TableAxis& a = axes_[axis];
    const double position = physics_->position(physics_->joints.axis[axis].slide);
    inputs.counts[axis] = a.encoder().counts(encoder_position(axis));
    inputs.servo_ready[axis] = a.drive().is_ready();
    inputs.alarm[axis] = a.drive().has_alarm();
    inputs.limit_positive[axis] = a.is_limit_positive(position);
    inputs.limit_negative[axis] = a.is_limit_negative(position);
  }
}

Status MujocoMachine::write(const Outputs& outputs) noexcept {
  if (state_ != State::kActive) {
    return stop_with(Fault::kNotActive);
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    if (!std::isfinite(outputs.volts[axis])) {
      return stop_with(Fault::kNotANumber);
    }
  }
  if (!std::isfinite(outputs.position_reference[2])) {
    return stop_with(Fault::kNotANumber);
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    axes_[axis].command(outputs.volts[axis], outputs.servo_on[axis]);
  }
  pen_reference_ = outputs.position_reference[2];
  return Status::kOk;
}

double MujocoMachine::encoder_position(std::size_t axis) const noexcept {
  const AxisJoints& joints = physics_->joints.axis[axis];
  return joints.is_compliant()
             ? physics_->data->qpos[joints.motor.qpos] * params_.axis[axis].mm_per_rad()
             : physics_->position(joints.slide);
}

Truth MujocoMachine::truth() const noexcept {
  Truth truth;
  if (physics_) {
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      truth.table_position[axis] =
          physics_->position(physics_->joints.axis[axis].slide) - origin_[axis];
    }
  }
  return truth;
}

double MujocoMachine::pen_position() const noexcept {
  return physics_ ? physics_->position(physics_->joints.pen) : 0.0;
}

double MujocoMachine::velocity(Axis axis) const noexcept {
  return physics_ ? physics_->velocity(physics_->joints.axis[axis].slide) : 0.0;
}

Status MujocoMachine::stop_with(Fault fault) noexcept {
  deactivate();
  fault_ = fault;
  return Status::kError;
}

void MujocoMachine::deactivate() noexcept {
  for (TableAxis& axis : axes_) {
    axis.switch_off();
  }
  if (state_ == State::kActive) {
    state_ = State::kInactive;
  }
}

void MujocoMachine::cleanup() noexcept {
  deactivate();
  axes_.clear();
  physics_.reset();
  fault_ = Fault::kNone;
  state_ = State::kUnconfigured;
}

std::string MujocoMachine::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kNotConfigured:
      return "the table was read before it was configured";
    case Fault::kNotActive:
      return "the table was written to while it was not active";
    case Fault::kNotANumber:
      return "a drive command or the pen's reference is not a finite number";
    case Fault::kUnstable:
      return fmt::format(
          "the simulated table became unstable at {:.4f} s; lower table.physics_step_ms or the "
          "gains",
          static_cast<double>(steps_done_) * step_);
    case Fault::kMujoco:
      return fmt::format("MuJoCo stopped at {:.4f} s: {}", static_cast<double>(steps_done_) * step_,
                         fault_text_.data());
  }
  return {};
}

}  // namespace twin::hal

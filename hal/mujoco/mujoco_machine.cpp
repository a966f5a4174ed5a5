#include "hal/mujoco/mujoco_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "hal/mujoco/table_physics.hpp"
#include "hal/mujoco/table_settings.hpp"

namespace twin::hal {

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
  if (!(period > 0.0) || !std::isfinite(period)) {
    return fail(ErrorCode::kMachine, fmt::format("period {} s is not above 0", period));
  }
  if (Expected<void> valid = validate(params_); !valid) {
    return valid;
  }
  steps_ = steps_per_period(period, params_.physics_step);
  step_ = period / steps_;
  Expected<std::unique_ptr<TablePhysics>> physics = TablePhysics::open(params_, step_);
  if (!physics) {
    return tl::unexpected<Error>(physics.error());
  }
  physics_ = std::move(*physics);
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
    axes_[axis].encoder().zero(physics_->encoder_position(axis));
    origin_[axis] = physics_->motion(axis).position;
  }
  state_ = State::kActive;
  return {};
}

void MujocoMachine::step() {
  const double time = static_cast<double>(steps_done_) * step_;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    AxisForces forces = axes_[axis].step(physics_->motion(axis), time);
    forces.slide += external_force_[axis];
    physics_->apply(axis, forces);
  }
  physics_->pull_pen(pen_reference_);
  physics_->step();
  ++steps_done_;
}

bool MujocoMachine::advance() noexcept {
  try {
    for (int i = 0; i < steps_; ++i) {
      step();
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
  if (physics_->is_unstable()) {
    return stop_with(Fault::kUnstable);
  }
  fill(inputs);
  return Status::kOk;
}

void MujocoMachine::fill(Inputs& inputs) const noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const TableAxis& a = axes_[axis];
    const double position = physics_->motion(axis).position;
    inputs.counts[axis] = a.encoder().counts(physics_->encoder_position(axis));
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

Truth MujocoMachine::truth() const noexcept {
  Truth truth;
  if (physics_) {
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      truth.table_position[axis] = physics_->motion(axis).position - origin_[axis];
    }
  }
  return truth;
}

double MujocoMachine::pen_position() const noexcept {
  return physics_ ? physics_->pen_position() : 0.0;
}

double MujocoMachine::velocity(Axis axis) const noexcept {
  return physics_ ? physics_->motion(axis).velocity : 0.0;
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

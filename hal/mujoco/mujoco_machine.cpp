#include "hal/mujoco/mujoco_machine.hpp"

#include <cmath>
#include <utility>

#include "hal/mujoco/table_plant.hpp"

namespace twin::hal::mujoco {

MujocoMachine::MujocoMachine(TableParams params) : params_(std::move(params)) {
  info_.name = "mujoco";
  info_.has_forces = true;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const AxisParams& p = params_.axis[axis];
    info_.mm_per_count[axis] = p.encoder.mm_per_count;
    info_.mm_per_s_per_volt[axis] = p.mm_per_s_per_volt();
  }
}

MujocoMachine::~MujocoMachine() = default;

std::optional<Error> MujocoMachine::configure(double period) {
  if (state_ == State::kActive) {
    return refusal("the table is active; deactivate it before configure");
  }
  cleanup();
  Expected<std::unique_ptr<TablePlant>> plant = TablePlant::open(params_, period);
  if (!plant) {
    return std::move(plant).error();
  }
  plant_ = std::move(*plant);
  origin_.fill(0.0);
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    dacs_.emplace_back(params_.axis[axis].dac_bits);
    encoders_.emplace_back(params_.axis[axis].encoder);
    plant_->set_external_force(axis, external_force_[axis]);
  }
  state_ = State::kInactive;
  return {};
}

std::optional<Error> MujocoMachine::activate() {
  if (state_ != State::kInactive) {
    return refusal(state_ == State::kActive ? "the table is active already"
                                            : "the table is not configured");
  }
  if (fault_ == Fault::kPlant) {
    return refusal("the table must be configured again: " + last_error());
  }
  fault_ = Fault::kNone;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    plant_->reset_drive(axis);
    encoders_[axis].zero(plant_->encoder_position(axis));
    origin_[axis] = plant_->position(axis);
  }
  state_ = State::kActive;
  return {};
}

Status MujocoMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    return stop_with(Fault::kNotConfigured);
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  if (!plant_->advance()) {
    return stop_with(Fault::kPlant);
  }
  fill(inputs);
  return Status::kOk;
}

void MujocoMachine::fill(Inputs& inputs) const noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    inputs.counts[axis] = encoders_[axis].counts(plant_->encoder_position(axis));
    inputs.servo_ready[axis] = plant_->is_ready(axis);
    inputs.alarm[axis] = plant_->has_alarm(axis);
    inputs.limit_positive[axis] = plant_->is_limit_positive(axis);
    inputs.limit_negative[axis] = plant_->is_limit_negative(axis);
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
    plant_->command(axis, dacs_[axis].convert(outputs.volts[axis]), outputs.servo_on[axis]);
  }
  plant_->set_pen_reference(outputs.position_reference[2]);
  return Status::kOk;
}

Truth MujocoMachine::truth() const noexcept {
  Truth truth;
  if (plant_) {
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      truth.table_position[axis] = plant_->position(axis) - origin_[axis];
      truth.motor_torque[axis] = plant_->torque(axis);
      truth.friction_force[axis] = plant_->friction(axis);
    }
  }
  return truth;
}

double MujocoMachine::pen_position() const noexcept {
  return plant_ ? plant_->pen_position() : 0.0;
}

double MujocoMachine::velocity(Axis axis) const noexcept {
  return plant_ ? plant_->velocity(axis) : 0.0;
}

void MujocoMachine::set_external_force(Axis axis, double force) noexcept {
  external_force_[axis] = force;
  if (plant_) {
    plant_->set_external_force(axis, force);
  }
}

Status MujocoMachine::stop_with(Fault fault) noexcept {
  deactivate();
  fault_ = fault;
  return Status::kError;
}

void MujocoMachine::deactivate() noexcept {
  for (std::size_t axis = 0; plant_ && axis < kServoAxes; ++axis) {
    plant_->command(axis, 0.0, false);
  }
  if (state_ == State::kActive) {
    state_ = State::kInactive;
  }
}

void MujocoMachine::cleanup() noexcept {
  deactivate();
  dacs_.clear();
  encoders_.clear();
  plant_.reset();
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
    case Fault::kPlant:
      return plant_->last_error();
  }
  return {};
}

}  // namespace twin::hal::mujoco

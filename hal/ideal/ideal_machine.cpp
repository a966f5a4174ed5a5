#include "hal/ideal/ideal_machine.hpp"

#include <fmt/format.h>

#include <cmath>

namespace twin::hal::ideal {
namespace {

constexpr double kMmPerCount = 1e-6;      // 1 nm: finer than any error of interest [mm]
constexpr double kMmPerSPerVolt = 100.0;  // so that servos can divide by something [mm/s/V]

}  // namespace

IdealMachine::IdealMachine() {
  info_.name = "ideal";
  info_.follows_reference = true;
  info_.mm_per_count.fill(kMmPerCount);
  info_.mm_per_s_per_volt.fill(kMmPerSPerVolt);
}

std::optional<Error> IdealMachine::configure(double period) {
  if (!(period > 0.0) || !std::isfinite(period)) {
    return refusal(fmt::format("period {} s is not above 0", period));
  }
  if (state_ == State::kActive) {
    return refusal("the ideal machine is active; deactivate it before configure");
  }
  fault_ = Fault::kNone;
  position_.fill(0.0);
  state_ = State::kInactive;
  return {};
}

std::optional<Error> IdealMachine::activate() {
  if (state_ != State::kInactive) {
    return refusal("the ideal machine is not inactive; configure it first");
  }
  fault_ = Fault::kNone;
  position_.fill(0.0);
  state_ = State::kActive;
  return {};
}

Status IdealMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    fault_ = Fault::kNotConfigured;
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  inputs = Inputs{};
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    inputs.counts[axis] = std::llround(position_[axis] / kMmPerCount);
    inputs.servo_ready[axis] = servo_on_[axis];
  }
  return Status::kOk;
}

Status IdealMachine::write(const Outputs& outputs) noexcept {
  if (state_ != State::kActive) {
    fault_ = Fault::kNotActive;
    return Status::kError;
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    if (!std::isfinite(outputs.position_reference[axis]) || !std::isfinite(outputs.volts[axis])) {
      deactivate();
      fault_ = Fault::kNotANumber;
      return Status::kError;
    }
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    position_[axis] = outputs.position_reference[axis];
    servo_on_[axis] = outputs.servo_on[axis];
  }
  return Status::kOk;
}

Truth IdealMachine::truth() const noexcept { return Truth{position_}; }

void IdealMachine::deactivate() noexcept {
  servo_on_.fill(false);
  if (state_ == State::kActive) {
    state_ = State::kInactive;
  }
}

void IdealMachine::cleanup() noexcept {
  deactivate();
  state_ = State::kUnconfigured;
}

std::string IdealMachine::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kNotConfigured:
      return "the ideal machine was read before it was configured";
    case Fault::kNotActive:
      return "the ideal machine was written to while it was not active";
    case Fault::kNotANumber:
      return "a drive command or position reference is not a finite number";
  }
  return {};
}

}  // namespace twin::hal::ideal

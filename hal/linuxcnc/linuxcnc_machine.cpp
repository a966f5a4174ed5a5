#include "hal/linuxcnc/linuxcnc_machine.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <string_view>
#include <utility>

namespace twin::hal::linuxcnc {
namespace {

constexpr std::int64_t kBeatPatience = 100'000'000;  // for a period of the servo thread [ns]
constexpr std::int64_t kStart = 1'000'000'000;       // for its first one [ns]
constexpr double kAlarmReset = 0.1;  // length of the pulse, and of the rest after it [s]
constexpr std::array<std::string_view, kServoAxes> kNames{"x", "y"};

std::uint32_t load(const std::uint32_t& word) noexcept {
  return std::atomic_ref(const_cast<std::uint32_t&>(word)).load(std::memory_order_acquire);
}

void store(std::uint32_t& word, std::uint32_t value) noexcept {
  std::atomic_ref(word).store(value, std::memory_order_release);
}

}  // namespace

LinuxCncMachine::LinuxCncMachine(const Scales& scales, std::string name)
    : name_(name.empty() ? default_segment_name(Role::kController) : std::move(name)) {
  info_.name = "linuxcnc";
  info_.simulated = false;
  info_.has_truth = false;
  info_.keeps_own_time = true;
  info_.gives_beat = true;
  info_.mm_per_count = scales.mm_per_count;
  info_.mm_per_s_per_volt = scales.mm_per_s_per_volt;
}

LinuxCncMachine::~LinuxCncMachine() { cleanup(); }

/// Waits for the next period of the servo thread.
bool LinuxCncMachine::wait_for_beat() noexcept { return shared_->wait_for_question(kBeatPatience); }

Expected<void> LinuxCncMachine::check_thread(double period) {
  shared_->drop_question();
  if (!shared_->wait_for_question(kStart)) {
    return fail(ErrorCode::kMachine,
                "LinuxCNC's servo thread does not call twinctl.read: addf twinctl.read and "
                "twinctl.write to it, and start it");
  }
  const double seen = shared_->memory().period;
  if (!(std::abs(seen - period) <= 0.005 * period)) {
    return fail(ErrorCode::kMachine,
                fmt::format("LinuxCNC's servo thread has a period of {:.4f} ms, and "
                            "interpolator.period_ms is {:.4f}: make them the same",
                            seen * 1e3, period * 1e3));
  }
  return {};
}

/// Both axes are there, with a position and an output that lead somewhere.
Expected<void> LinuxCncMachine::check_wires() const {
  const twin_segment& memory = shared_->memory();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const std::string_view name = kNames[axis];
    const std::string_view found(memory.axis[place_[axis]].name);
    const std::uint32_t wired = memory.axis[place_[axis]].feedback.wired;
    if (found != name) {
      return fail(ErrorCode::kMachine,
                  fmt::format("twinctl has no axis {}: loadrt twinctl axes=xy", name));
    }
    if ((wired & (TWIN_WIRED_COUNT | TWIN_WIRED_POSITION)) == 0) {
      return fail(ErrorCode::kMachine,
                  fmt::format("nothing in HAL is connected to twinctl.{0}.count or "
                              "twinctl.{0}.position-fb: net the encoder's pin to one of them",
                              name));
    }
    if ((wired & TWIN_WIRED_OUTPUT) == 0) {
      return fail(ErrorCode::kMachine,
                  fmt::format("twinctl.{0}.volts and twinctl.{0}.velocity-cmd lead nowhere in HAL: "
                              "net one of them to the drive's command",
                              name));
    }
  }
  return {};
}

std::optional<Error> LinuxCncMachine::configure(double period) {
  if (state_ == State::kActive) {
    return refusal("LinuxCNC's machine is active; deactivate it before configure");
  }
  cleanup();
  if (!(period > 0.0) || !std::isfinite(period)) {
    return refusal(fmt::format("period {} s is not above 0", period));
  }
  auto shared = SharedSegment::attach_controller(name_);
  if (!shared) {
    return std::move(shared).error();
  }
  shared_ = *std::move(shared);
  twin_segment& memory = shared_->memory();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    place_[axis] = axis;
    for (std::size_t i = 0; i < memory.axes && i < TWIN_SEGMENT_AXES; ++i) {
      if (std::string_view(memory.axis[i].name) == kNames[axis]) {
        place_[axis] = i;
      }
    }
    memory.axis[place_[axis]].mm_per_count = info_.mm_per_count[axis];
    memory.axis[place_[axis]].mm_per_s_per_volt = info_.mm_per_s_per_volt[axis];
  }
  store(memory.is_running, 0);
  Expected<void> checked_all = check_thread(period);
  if (checked_all) {
    checked_all = check_wires();
  }
  if (!checked_all) {
    shared_.reset();
    return std::move(checked_all).error();
  }
  state_ = State::kInactive;
  return {};
}

/// Resets alarms by a pulse, and refuses drives that keep theirs.
Expected<void> LinuxCncMachine::get_ready() {
  twin_segment& memory = shared_->memory();
  const auto alarm = [&] {
    std::size_t axis = 0;
    while (axis < kServoAxes && memory.axis[place_[axis]].feedback.alarm == 0) {
      ++axis;
    }
    return axis;
  };
  const bool has_alarm = alarm() < kServoAxes;
  const auto pulse = static_cast<int>(std::ceil(kAlarmReset / memory.period));
  store(memory.is_running, has_alarm ? 1 : 0);
  for (int i = 0; has_alarm && i < 2 * pulse; ++i) {
    for (const std::size_t place : place_) {
      memory.axis[place].command.fault_reset = i < pulse ? 1 : 0;
    }
    shared_->answer();
    if (!wait_for_beat()) {
      break;
    }
  }
  store(memory.is_running, 0);
  if (alarm() < kServoAxes) {
    return fail(ErrorCode::kMachine,
                fmt::format("axis {}: the drive has an alarm after its reset (twinctl.{}.fault)",
                            kNames[alarm()], kNames[alarm()]));
  }
  if (memory.is_estop != 0) {
    return fail(ErrorCode::kMachine, "the emergency stop is on (twinctl.estop)");
  }
  return wait_for_standstill();
}

/// An axis that still coasts has no position to make zero: its counts must stay, but for one of
/// noise.
Expected<void> LinuxCncMachine::wait_for_standstill() {
  constexpr double kLook = 0.05;     // [s]
  constexpr double kPatience = 3.0;  // [s]
  const auto periods = static_cast<int>(std::ceil(kLook / shared_->memory().period));
  std::size_t moving = kX;
  for (double passed = 0.0; passed < kPatience; passed += kLook) {
    const std::array before{counts(kX), counts(kY)};
    for (int i = 0; i < periods; ++i) {
      shared_->drop_question();
      if (!wait_for_beat()) {
        return fail(ErrorCode::kMachine, "LinuxCNC's servo thread stands");
      }
    }
    moving = std::abs(counts(kX) - before[kX]) > 1 ? kX : kY;
    if (std::abs(counts(moving) - before[moving]) <= 1) {
      return {};
    }
  }
  return fail(
      ErrorCode::kMachine,
      fmt::format("axis {} still moves {:g} s after 0 V and servo off; wait until it stands",
                  kNames[moving], kPatience));
}

std::optional<Error> LinuxCncMachine::activate() {
  if (state_ != State::kInactive) {
    return refusal(state_ == State::kActive ? "LinuxCNC's machine is active already"
                                            : "LinuxCNC's machine is not configured");
  }
  command_nothing();
  shared_->drop_question();
  if (!wait_for_beat()) {
    return refusal("LinuxCNC's servo thread does not call twinctl.read any more");
  }
  if (Expected<void> ready = get_ready(); !ready) {
    deactivate();
    return std::move(ready).error();
  }
  twin_segment& memory = shared_->memory();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    origin_[axis] = 0;
    origin_[axis] = counts(axis);
    index_marks_[axis] = memory.axis[place_[axis]].feedback.index_marks;
  }
  command_nothing();
  store(memory.is_running, 0);  // nobody answers before the first read()
  shared_->answer();
  fault_ = Fault::kNone;
  state_ = State::kActive;
  return {};
}

/// Counts since activate(), of a counter or made of a position.
std::int64_t LinuxCncMachine::counts(std::size_t axis) const noexcept {
  const twin_feedback& feedback = shared_->memory().axis[place_[axis]].feedback;
  if ((feedback.wired & TWIN_WIRED_COUNT) != 0) {
    return feedback.counts - origin_[axis];
  }
  const double position = feedback.position / info_.mm_per_count[axis];
  return std::isfinite(position) ? std::llround(position) - origin_[axis] : 0;
}

void LinuxCncMachine::fill(Inputs& inputs) noexcept {
  twin_segment& memory = shared_->memory();
  const std::uint64_t periods = std::atomic_ref(memory.periods_asked).load();
  inputs.periods = is_driving_ && periods > periods_ ? static_cast<int>(periods - periods_) : 1;
  periods_ = periods;
  is_feed_held_.store(memory.is_hold != 0, std::memory_order_relaxed);
  if (std::isfinite(memory.feed_override)) {
    feed_percent_.store(100.0 * memory.feed_override, std::memory_order_relaxed);
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const twin_feedback& feedback = memory.axis[place_[axis]].feedback;
    const bool is_ready_wired = (feedback.wired & TWIN_WIRED_READY) != 0;
    inputs.counts[axis] = counts(axis);
    inputs.servo_ready[axis] = is_ready_wired ? feedback.ready != 0 : servo_on_[axis];
    inputs.alarm[axis] = feedback.alarm != 0;
    inputs.limit_positive[axis] = feedback.limit_positive != 0;
    inputs.limit_negative[axis] = feedback.limit_negative != 0;
    inputs.index[axis] = feedback.index_marks != index_marks_[axis];
    index_marks_[axis] = feedback.index_marks;
  }
}

Status LinuxCncMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    return stop_with(Fault::kNotConfigured);
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  if (!is_driving_) {
    shared_->drop_question();  // it is as old as the last answer
  }
  if (!wait_for_beat()) {
    return stop_with(shared_->has_shim() ? Fault::kStands : Fault::kGone);
  }
  const twin_segment& memory = shared_->memory();
  if (state_ == State::kActive && memory.is_estop != 0) {
    return stop_with(Fault::kEmergencyStop);
  }
  if (is_driving_ && load(memory.has_switched_off) != 0) {
    return stop_with(Fault::kSwitchedOff);
  }
  fill(inputs);
  return Status::kOk;
}

Status LinuxCncMachine::write(const Outputs& outputs) noexcept {
  if (state_ != State::kActive) {
    return stop_with(Fault::kNotActive);
  }
  if (!std::isfinite(outputs.volts[kX]) || !std::isfinite(outputs.volts[kY]) ||
      !std::isfinite(outputs.position_reference[2])) {
    return stop_with(Fault::kNotANumber);
  }
  twin_segment& memory = shared_->memory();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    twin_command& command = memory.axis[place_[axis]].command;
    command.volts = outputs.servo_on[axis] ? outputs.volts[axis] : 0.0;
    command.servo_on = outputs.servo_on[axis] ? 1 : 0;
    command.position = outputs.position_reference[axis];
    command.fault_reset = 0;
  }
  servo_on_ = outputs.servo_on;
  if (!is_driving_) {
    is_driving_ = true;
    store(memory.is_running, 1);
  }
  ++memory.periods_answered;
  shared_->answer();
  return Status::kOk;
}

void LinuxCncMachine::command_nothing() noexcept {
  for (const std::size_t place : place_) {
    twin_command& command = shared_->memory().axis[place].command;
    command.volts = 0.0;
    command.servo_on = 0;
    command.fault_reset = 0;
  }
}

Status LinuxCncMachine::stop_with(Fault fault) noexcept {
  deactivate();
  fault_ = fault;
  return Status::kError;
}

void LinuxCncMachine::deactivate() noexcept {
  servo_on_.fill(false);
  is_driving_ = false;
  if (shared_) {
    command_nothing();
    store(shared_->memory().is_running, 0);
    shared_->answer();
  }
  if (state_ == State::kActive) {
    state_ = State::kInactive;
  }
}

void LinuxCncMachine::cleanup() noexcept {
  deactivate();
  shared_.reset();
  fault_ = Fault::kNone;
  state_ = State::kUnconfigured;
}

std::string LinuxCncMachine::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kNotConfigured:
      return "LinuxCNC's machine was read before it was configured";
    case Fault::kNotActive:
      return "LinuxCNC's machine was written to while it was not active";
    case Fault::kNotANumber:
      return "a drive command or the pen's reference is not a finite number";
    case Fault::kGone:
      return "LinuxCNC is gone: its component twinctl no longer answers";
    case Fault::kStands:
      return fmt::format("LinuxCNC's servo thread has stood for {} ms", kBeatPatience / 1'000'000);
    case Fault::kSwitchedOff:
      return fmt::format(
          "LinuxCNC's component twinctl has made the outputs safe: more than {} periods in a row "
          "without an answer in time",
          shared_ ? shared_->memory().hold_periods : 0);
    case Fault::kEmergencyStop:
      return "emergency stop (twinctl.estop)";
  }
  return {};
}

}  // namespace twin::hal::linuxcnc

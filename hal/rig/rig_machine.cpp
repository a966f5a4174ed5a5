#include "hal/rig/rig_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {

RigMachine::RigMachine(RigSettings settings, const TableScales& table, CardsFactory open_cards,
                       std::shared_ptr<Bench> bench, Watch* watch)
    : settings_(std::move(settings)),
      drives_(settings_.axis.begin(), settings_.axis.end()),
      open_cards_(std::move(open_cards)),
      bench_(std::move(bench)),
      watch_(watch) {
  info_.name = "rig";
  info_.simulated = bench_ != nullptr;
  info_.has_truth = bench_ != nullptr;
  info_.keeps_own_time = bench_ == nullptr || bench_->keeps_own_time();
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    info_.mm_per_count[axis] = drives_[axis].mm_per_count(table.mm_per_count[axis]);
    info_.mm_per_s_per_volt[axis] = drives_[axis].mm_per_s_per_volt(table.mm_per_s_per_volt[axis]);
  }
}

RigMachine::~RigMachine() { deactivate(); }

std::optional<Error> RigMachine::configure(double period) {
  if (state_ == State::kActive) {
    return refusal("the rig is active; deactivate it before configure");
  }
  cleanup();
  if (!(period > 0.0) || !std::isfinite(period)) {
    return refusal(fmt::format("period {} s is not above 0", period));
  }
  if (bench_ != nullptr) {
    if (Expected<void> on = bench_->power_on(period); !on) {
      return std::move(on).error();
    }
  }
  Expected<std::unique_ptr<Cards>> cards = open_cards_();
  if (!cards) {
    return std::move(cards).error();
  }
  cards_ = *std::move(cards);
  emergency_.emplace(*cards_);
  period_ = period;
  state_ = State::kInactive;
  return {};
}

Expected<void> RigMachine::fetch(CardInputs& inputs) {
  return cards_->read(inputs) == Status::kOk ? Expected<void>{}
                                             : fail(ErrorCode::kMachine, cards_->last_error());
}

// Lets time pass on the wall clock and, where time is the bench's own, there too.
Expected<void> RigMachine::wait(double time) {
  const auto periods = std::max(1L, std::lround(time / period_));
  for (long i = 0; i < periods; ++i) {
    if (bench_ != nullptr && !bench_->advance()) {
      return fail(ErrorCode::kMachine, bench_->last_error());
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(period_));
  }
  return {};
}

// A pulse on /ALM-RST of each drive that has an alarm, then as long a rest.
Expected<void> RigMachine::reset_alarms(CardInputs& inputs) {
  CardOutputs pulse;
  pulse.digital = safe_digital(settings_);
  for (const Servopack& drive : drives_) {
    const bool has_alarm = drive.decode(inputs.digital, false).alarm;
    pulse.digital = drive.with_outputs(false, has_alarm, pulse.digital);
  }
  if (cards_->write(pulse) == Status::kError) {
    return fail(ErrorCode::kMachine, cards_->last_error());
  }
  TWIN_CHECK(wait(settings_.alarm_reset_time));
  cards_->make_safe();
  TWIN_CHECK(wait(settings_.alarm_reset_time));
  return fetch(inputs);
}

// A table that still coasts has no position to make zero: its counts must stay, but for one of
// noise.
Expected<void> RigMachine::wait_for_standstill(CardInputs& inputs) {
  constexpr double kLook = 0.05;     // [s]
  constexpr double kPatience = 3.0;  // [s]
  std::size_t moving = kX;
  for (double passed = 0.0; passed < kPatience; passed += kLook) {
    const CardInputs before = inputs;
    TWIN_CHECK(wait(kLook));
    TWIN_CHECK(fetch(inputs));
    const auto has_moved = [&](std::size_t axis) {
      const auto counter = static_cast<std::size_t>(settings_.axis[axis].counter);
      return std::abs(inputs.counts[counter] - before.counts[counter]) > 1;
    };
    if (!has_moved(kX) && !has_moved(kY)) {
      return {};
    }
    moving = has_moved(kX) ? kX : kY;
  }
  return fail(
      ErrorCode::kMachine,
      fmt::format("axis {} still moves {:g} s after 0 V and servo off; wait until it stands",
                  "xy"[moving], kPatience));
}

/// The drives have no alarm, the limit switches say that the table may move, and it stands.
Expected<void> RigMachine::get_ready(CardInputs& inputs) {
  TWIN_CHECK(fetch(inputs));
  if (has_alarm(settings_, inputs.digital)) {
    TWIN_CHECK(reset_alarms(inputs));
  }
  TWIN_CHECK(check_drives(settings_, inputs.digital));
  return info_.keeps_own_time ? wait_for_standstill(inputs) : Expected<void>();
}

std::optional<Error> RigMachine::activate() {
  if (state_ != State::kInactive) {
    return refusal(state_ == State::kActive ? "the rig is active already"
                                            : "the rig is not configured");
  }
  cards_->make_safe();
  if (has_guard_acted()) {
    return refusal("the guard has made the outputs safe; start the program anew");
  }
  CardInputs inputs;
  if (Expected<void> ready = get_ready(inputs); !ready) {
    cards_->make_safe();
    return std::move(ready).error();
  }
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    home_[axis] = inputs.counts[static_cast<std::size_t>(settings_.axis[axis].counter)];
  }
  origin_ = bench_ != nullptr ? bench_->truth() : Truth{};
  servo_on_.fill(false);
  fault_ = Fault::kNone;
  state_ = State::kActive;
  return {};
}

Status RigMachine::read(Inputs& inputs) noexcept {
  if (state_ == State::kUnconfigured) {
    return stop_with(Fault::kNotConfigured);
  }
  if (fault_ != Fault::kNone) {
    return Status::kError;
  }
  if (state_ == State::kActive && has_guard_acted()) {
    return stop_with(Fault::kGuard);
  }
  if (bench_ != nullptr && !bench_->advance()) {
    return stop_with(Fault::kBench);
  }
  CardInputs card;
  if (cards_->read(card) == Status::kError) {
    return stop_with(Fault::kCards);
  }
  fill(card, inputs);
  return Status::kOk;
}

void RigMachine::fill(const CardInputs& card, Inputs& inputs) const noexcept {
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const auto counter = static_cast<std::size_t>(settings_.axis[axis].counter);
    const DriveInputs drive = drives_[axis].decode(card.digital, servo_on_[axis]);
    inputs.counts[axis] = card.counts[counter] - home_[axis];
    inputs.servo_ready[axis] = drive.ready;
    inputs.alarm[axis] = drive.alarm;
    inputs.limit_positive[axis] = drive.limit_positive;
    inputs.limit_negative[axis] = drive.limit_negative;
    inputs.index[axis] = (card.index_seen >> counter & 1) != 0;
  }
}

CardOutputs RigMachine::card_outputs(const Outputs& outputs) const noexcept {
  CardOutputs card;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    const bool servo_on = outputs.servo_on[axis];
    card.digital = drives_[axis].with_outputs(servo_on, false, card.digital);
    card.volts[static_cast<std::size_t>(settings_.axis[axis].dac)] =
        drives_[axis].vref(outputs.volts[axis], servo_on);
  }
  return card;
}

Status RigMachine::write(const Outputs& outputs) noexcept {
  if (state_ != State::kActive) {
    return stop_with(Fault::kNotActive);
  }
  if (!std::isfinite(outputs.volts[kX]) || !std::isfinite(outputs.volts[kY]) ||
      !std::isfinite(outputs.position_reference[2])) {
    return stop_with(Fault::kNotANumber);
  }
  if (has_guard_acted()) {
    return stop_with(Fault::kGuard);
  }
  if (watch_ != nullptr && !watch_->is_alive()) {
    return stop_with(Fault::kGuardGone);
  }
  if (watch_ != nullptr && !is_armed_) {
    is_armed_ = true;
    watch_->arm();
  }
  if (bench_ != nullptr) {
    bench_->set_pen_reference(outputs.position_reference[2]);
  }
  servo_on_ = outputs.servo_on;
  if (cards_->write(card_outputs(outputs)) == Status::kError) {
    return stop_with(Fault::kCards);
  }
  if (watch_ != nullptr) {
    watch_->beat();
    if (watch_->has_acted()) {  // while this write was under way: it must not be the last
      return stop_with(Fault::kGuard);
    }
  }
  return Status::kOk;
}

Truth RigMachine::truth() const noexcept {
  Truth truth;
  if (bench_ != nullptr && state_ != State::kUnconfigured) {
    truth = bench_->truth();
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      truth.table_position[axis] -= origin_.table_position[axis];
    }
  }
  return truth;
}

Status RigMachine::stop_with(Fault fault) noexcept {
  deactivate();
  fault_ = fault;
  return Status::kError;
}

// Safe values are written even after the guard has acted: a write that it overtook may have come
// after them.
void RigMachine::deactivate() noexcept {
  if (cards_ != nullptr) {
    cards_->make_safe();
  }
  servo_on_.fill(false);
  if (is_armed_) {
    watch_->disarm();
    is_armed_ = false;
  }
  if (state_ == State::kActive) {
    state_ = State::kInactive;
  }
}

void RigMachine::cleanup() noexcept {
  deactivate();
  emergency_.reset();
  cards_.reset();
  home_.fill(0);
  origin_ = {};
  fault_ = Fault::kNone;
  state_ = State::kUnconfigured;
}

std::string RigMachine::last_error() const {
  switch (fault_) {
    case Fault::kNone:
      return {};
    case Fault::kNotConfigured:
      return "the rig was read before it was configured";
    case Fault::kNotActive:
      return "the rig was written to while it was not active";
    case Fault::kNotANumber:
      return "a drive command or the pen's reference is not a finite number";
    case Fault::kCards:
      return cards_->last_error();
    case Fault::kBench:
      return bench_->last_error();
    case Fault::kGuard:
      return "the guard has made the outputs safe: heartbeats were missing for too long";
    case Fault::kGuardGone:
      return "the guard process is gone: nothing would make the outputs safe if this one hung";
  }
  return {};
}

}  // namespace twin::hal::rig

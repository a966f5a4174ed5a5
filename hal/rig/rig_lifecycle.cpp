#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "hal/rig/drive_check.hpp"
#include "hal/rig/rig_machine.hpp"

// How the rig is configured, switched on and off; its cycle is in rig_machine.cpp.
namespace twin::hal::rig {

Expected<void> RigMachine::configure(double period) {
  if (state_ == State::kActive) {
    return fail(ErrorCode::kMachine, "the rig is active; deactivate it before configure");
  }
  cleanup();
  if (!(period > 0.0) || !std::isfinite(period)) {
    return fail(ErrorCode::kMachine, fmt::format("period {} s is not above 0", period));
  }
  if (bench_ != nullptr) {
    if (Expected<void> on = bench_->power_on(period); !on) {
      return on;
    }
  }
  Expected<std::unique_ptr<Cards>> cards = open_cards_();
  if (!cards) {
    return tl::unexpected(cards.error());
  }
  cards_ = std::move(*cards);
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
  return wait(settings_.alarm_reset_time)
      .and_then([&] {
        cards_->make_safe();
        return wait(settings_.alarm_reset_time);
      })
      .and_then([&] { return fetch(inputs); });
}

// A table that still coasts has no position to make zero: its counts must stay, but for one of
// noise.
Expected<void> RigMachine::wait_for_standstill(CardInputs& inputs) {
  constexpr double kLook = 0.05;     // [s]
  constexpr double kPatience = 3.0;  // [s]
  std::size_t moving = kX;
  for (double passed = 0.0; passed < kPatience; passed += kLook) {
    const CardInputs before = inputs;
    if (auto looked = wait(kLook).and_then([&] { return fetch(inputs); }); !looked) {
      return looked;
    }
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

Expected<void> RigMachine::activate() {
  if (state_ != State::kInactive) {
    return fail(ErrorCode::kMachine, state_ == State::kActive ? "the rig is active already"
                                                              : "the rig is not configured");
  }
  cards_->make_safe();
  if (has_guard_acted()) {
    return fail(ErrorCode::kMachine, "the guard has made the outputs safe; start the program anew");
  }
  CardInputs inputs;
  Expected<void> ready = fetch(inputs);
  if (ready && has_alarm(settings_, inputs.digital)) {
    ready = reset_alarms(inputs);
  }
  ready = ready.and_then([&] { return check_drives(settings_, inputs.digital); });
  if (ready && info_.keeps_own_time) {
    ready = wait_for_standstill(inputs);
  }
  if (!ready) {
    cards_->make_safe();
    return ready;
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

}  // namespace twin::hal::rig

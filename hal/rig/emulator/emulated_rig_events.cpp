// Faults and events of the emulated rig.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/monotonic.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"

namespace twin::hal::rig::emulator {

void EmulatedRig::tell(EventKind kind, std::size_t index, std::int64_t value) noexcept {
  events_.add({kind, index, value, time(), monotonic_ns()});
}

void EmulatedRig::strike_due_faults() noexcept {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    std::optional<double> ready = state_[fault.axis].first_ready;
    if (!has_axis(fault.kind)) {
      ready = state_[kX].first_ready;
      const std::optional<double> other = state_[kY].first_ready;
      ready = ready && other ? std::min(*ready, *other) : ready ? ready : other;
    }
    // Half a period of tolerance: the sum of periods is not exact.
    if (struck_[i] == 0 && ready && time() >= *ready + fault.time - 0.5 * period_) {
      struck_[i] = 1;
      inject(fault);
    }
  }
}

void EmulatedRig::inject(const Fault& fault) noexcept {
  AxisState& state = state_[fault.axis];
  tell(EventKind::kFault, fault.axis, static_cast<std::int64_t>(fault.kind));
  state.broken.set(static_cast<std::size_t>(fault.kind));
  switch (fault.kind) {
    case FaultKind::kEncoderLostCounts:
      state.edges_to_lose += kLostCounts;
      break;
    case FaultKind::kDacStuck:
      state.stuck_volts = dac_volts(fault.axis);
      break;
    case FaultKind::kAlarm:
      if (plant_) {
        plant_->trip(fault.axis);
      }
      break;
    case FaultKind::kLimitPositive:
    case FaultKind::kLimitNegative:
      if (plant_) {
        plant_->force_limits(fault.axis, is_broken(fault.axis, FaultKind::kLimitPositive),
                             is_broken(fault.axis, FaultKind::kLimitNegative));
      }
      break;
    case FaultKind::kCardGone1716:
      boards_->pci1716.is_present.store(false);
      break;
    case FaultKind::kCardGone1784:
      boards_->pci1784.is_present.store(false);
      break;
    default:
      break;
  }
}

void EmulatedRig::notice_outputs(std::uint16_t digital_out) noexcept {
  if (digital_out != digital_out_) {
    digital_out_ = digital_out;
    tell(EventKind::kDigitalOut, 0, digital_out);
  }
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    Event event;
    event.index = i;
    if (rest_[i].take(boards_->pci1716.dac[i].load(), time(), event)) {
      events_.add(event);
    }
  }
}

void EmulatedRig::notice(std::size_t axis) noexcept {
  AxisState& state = state_[axis];
  const auto changed = [](bool& last, bool now) { return std::exchange(last, now) != now; };
  if (changed(state.is_ready, plant_->is_ready(axis))) {
    tell(state.is_ready ? EventKind::kServoReady : EventKind::kServoOff, axis, 0);
  }
  if (changed(state.has_alarm, plant_->has_alarm(axis))) {
    tell(state.has_alarm ? EventKind::kAlarm : EventKind::kAlarmCleared, axis, 0);
  }
  if (changed(state.is_limit_positive, plant_->is_limit_positive(axis))) {
    tell(EventKind::kLimitPositive, axis, state.is_limit_positive ? 1 : 0);
  }
  if (changed(state.is_limit_negative, plant_->is_limit_negative(axis))) {
    tell(EventKind::kLimitNegative, axis, state.is_limit_negative ? 1 : 0);
  }
  if (state.is_ready && !state.first_ready) {
    state.first_ready = time();
  }
}

}  // namespace twin::hal::rig::emulator

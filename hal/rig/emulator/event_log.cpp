#include "hal/rig/emulator/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/wall_clock.hpp"
#include "hal/machine.hpp"
#include "hal/rig/emulator/fault.hpp"

namespace twin::hal::rig::emulator {
namespace {

constexpr std::uint16_t kZeroVolts = 0x8000;

std::string fault_text(const Event& event) {
  const auto kind = static_cast<FaultKind>(event.value);
  const char* axis = event.index == kX ? " of x" : " of y";
  return fmt::format("fault {}{}", to_string(kind), has_axis(kind) ? axis : "");
}

std::string what(const Event& event) {
  const char axis = event.index == kX ? 'x' : 'y';
  const char* state = event.value != 0 ? "open" : "closed";
  switch (event.kind) {
    case EventKind::kDacDriven:
      return fmt::format("DAC {} leaves 0x8000 for 0x{:04X}", event.index, event.value);
    case EventKind::kDacAtZero:
      return fmt::format("DAC {} at 0x8000", event.index);
    case EventKind::kDigitalOut:
      return fmt::format("digital outputs 0x{:04X}", event.value);
    case EventKind::kServoReady:
      return fmt::format("servo {} ready", axis);
    case EventKind::kServoOff:
      return fmt::format("servo {} off", axis);
    case EventKind::kAlarm:
      return fmt::format("alarm of drive {}", axis);
    case EventKind::kAlarmCleared:
      return fmt::format("alarm of drive {} cleared", axis);
    case EventKind::kLimitPositive:
      return fmt::format("P-OT of {} {}", axis, state);
    case EventKind::kLimitNegative:
      return fmt::format("N-OT of {} {}", axis, state);
    case EventKind::kFault:
      return fault_text(event);
    case EventKind::kControllerJoined:
      return fmt::format("controller {} joined", event.value);
    case EventKind::kControllerLeft:
      return fmt::format("controller {} left", event.value);
    case EventKind::kControllerDied:
      return fmt::format("controller {} died", event.value);
    case EventKind::kFellBehind:
      return fmt::format("{} ms of the wall clock left out", event.value);
  }
  return {};
}

}  // namespace

std::string to_string(const Event& event) {
  return fmt::format("plant {:.6f} s, clock {}.{:09} s: {}", event.plant_time,
                     event.monotonic_ns / kNsPerS, event.monotonic_ns % kNsPerS, what(event));
}

std::vector<Event> in_order(std::vector<Event> events) {
  std::ranges::stable_sort(events, {}, &Event::monotonic_ns);
  return events;
}

bool RestWatch::take(std::uint16_t code, double plant_time, Event& event) noexcept {
  if (code != kZeroVolts) {
    is_zero_ = false;
    event = {EventKind::kDacDriven, event.index, code, plant_time, 0};
    if (is_driven_) {
      return false;
    }
    event.monotonic_ns = monotonic_ns();
    return is_driven_ = true;
  }
  if (!is_zero_) {
    is_zero_ = true;
    since_ = plant_time;
    since_ns_ = monotonic_ns();
  }
  if (!is_driven_ || plant_time - since_ < kRestTime) {
    return false;
  }
  event = {EventKind::kDacAtZero, event.index, code, since_, since_ns_};
  is_driven_ = false;
  return true;
}

}  // namespace twin::hal::rig::emulator

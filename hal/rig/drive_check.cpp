#include "hal/rig/drive_check.hpp"

#include <fmt/format.h>

#include "hal/rig/servopack.hpp"

namespace twin::hal::rig {
namespace {

constexpr char kAxisNames[] = "xy";

std::string level_text(const Line& line) {
  return fmt::format("DI {} is {}", line.channel, line.when == Level::kHigh ? "high" : "low");
}

}  // namespace

bool has_alarm(const RigSettings& settings, std::uint16_t inputs) noexcept {
  for (const AxisWiring& axis : settings.axis) {
    if (is_given(axis.alarm, inputs)) {
      return true;
    }
  }
  return false;
}

Expected<void> check_drives(const RigSettings& settings, std::uint16_t inputs) {
  for (std::size_t i = 0; i < kServoAxes; ++i) {
    const AxisWiring& axis = settings.axis[i];
    if (is_given(axis.alarm, inputs)) {
      return fail(ErrorCode::kMachine,
                  fmt::format("axis {}: the drive has an alarm after its reset (ALM, {}): read the "
                              "drive's panel; without an alarm there, the wire is broken or "
                              "rig.{}.alarm_level is wrong",
                              kAxisNames[i], level_text(axis.alarm), kAxisNames[i]));
    }
    if (is_given(axis.limit_positive, inputs) && is_given(axis.limit_negative, inputs)) {
      return fail(ErrorCode::kMachine,
                  fmt::format("axis {}: both limit switches are off at once (P-OT, {}; N-OT, {}): "
                              "the cable is off, or limit_positive_level and limit_negative_level "
                              "of rig.{} are wrong",
                              kAxisNames[i], level_text(axis.limit_positive),
                              level_text(axis.limit_negative), kAxisNames[i]));
    }
  }
  return {};
}

}  // namespace twin::hal::rig

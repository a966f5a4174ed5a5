#include "hal/rig/servopack.hpp"

#include <fmt/format.h>

namespace twin::hal::rig {
namespace {

constexpr unsigned mask_of(const Line& line) { return 1u << static_cast<unsigned>(line.channel); }

double signed_scale(double setting, double table, bool reversed) noexcept {
  const double scale = setting != 0.0 ? setting : table;
  return reversed ? -scale : scale;
}

constexpr char kAxisNames[] = "xy";

std::string level_text(const Line& line) {
  return fmt::format("DI {} is {}", line.channel, line.when == Level::kHigh ? "high" : "low");
}

}  // namespace

bool is_given(const Line& line, std::uint16_t levels) noexcept {
  return line.channel >= 0 && ((levels & mask_of(line)) != 0) == (line.when == Level::kHigh);
}

std::uint16_t with_signal(const Line& line, bool given, std::uint16_t levels) noexcept {
  if (line.channel < 0) {
    return levels;
  }
  const bool is_high = given == (line.when == Level::kHigh);
  return static_cast<std::uint16_t>(is_high ? levels | mask_of(line) : levels & ~mask_of(line));
}

std::uint16_t safe_digital(const RigSettings& settings) noexcept {
  std::uint16_t levels = 0;
  for (const AxisWiring& axis : settings.axis) {
    levels = Servopack(axis).with_outputs(false, false, levels);
  }
  return levels;
}

double Servopack::vref(double command, bool servo_on) const noexcept {
  return servo_on ? command + wiring_.vref_trim : command;
}

std::uint16_t Servopack::with_outputs(bool servo_on, bool alarm_reset,
                                      std::uint16_t levels) const noexcept {
  return with_signal(wiring_.alarm_reset, alarm_reset,
                     with_signal(wiring_.servo_on, servo_on, levels));
}

DriveInputs Servopack::decode(std::uint16_t levels, bool servo_on) const noexcept {
  const bool says_ready = wiring_.ready.channel < 0 || is_given(wiring_.ready, levels);
  return {.ready = servo_on && says_ready,
          .alarm = is_given(wiring_.alarm, levels),
          .limit_positive = is_given(wiring_.limit_positive, levels),
          .limit_negative = is_given(wiring_.limit_negative, levels)};
}

double Servopack::mm_per_count(double table) const noexcept {
  return signed_scale(wiring_.mm_per_count, table, wiring_.encoder_reversed);
}

double Servopack::mm_per_s_per_volt(double table) const noexcept {
  return signed_scale(wiring_.mm_per_s_per_volt, table, wiring_.vref_reversed);
}

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

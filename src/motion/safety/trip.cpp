#include "motion/safety/trip.hpp"

#include <fmt/format.h>

#include <string_view>

namespace twin::motion {
namespace {

std::string measure(const Trip& trip) {
  switch (trip.kind) {
    case Kind::kTrackingError:
      return fmt::format("tracking error {:.3f} mm, limit {:.3f} mm", trip.value, trip.limit);
    case Kind::kPositiveLimit:
      return fmt::format("limit switch P-OT met at {:.3f} mm", trip.value);
    case Kind::kNegativeLimit:
      return fmt::format("limit switch N-OT met at {:.3f} mm", trip.value);
    case Kind::kDriveAlarm:
      return "drive alarm";
    case Kind::kReadyLost:
      return "servo ready went off";
    case Kind::kNotReady:
      return fmt::format("no servo ready after {:.0f} ms, limit {:.0f} ms", trip.value * 1e3,
                         trip.limit * 1e3);
    case Kind::kEncoderFrozen:
      return fmt::format(
          "encoder counts stand while the set point moved {:.3f} mm, limit {:.3f} mm", trip.value,
          trip.limit);
    case Kind::kRunaway:
      return fmt::format("moves against its drive command, error {:.3f} mm, limit {:.3f} mm",
                         trip.value, trip.limit);
    case Kind::kCountStep:
      return fmt::format("encoder jumped by {:.3f} mm in a period, limit {:.3f} mm", trip.value,
                         trip.limit);
    case Kind::kSaturation:
      return fmt::format("drive command at 10 V for {:.0f} ms, limit {:.0f} ms", trip.value * 1e3,
                         trip.limit * 1e3);
    case Kind::kLatePeriods:
      return fmt::format("{:.0f} periods in a row began late, limit {:.0f}", trip.value,
                         trip.limit);
    case Kind::kStall:
      return fmt::format("a period began {:.1f} ms late, limit {:.1f} ms", trip.value * 1e3,
                         trip.limit * 1e3);
    case Kind::kSamplesLost:
      return "samples came faster than they could be written";
    case Kind::kServoFailed:
      return "the servo gave no drive command";
    case Kind::kOutsideTravel:
      return fmt::format("the next set point is {:.4f} mm, its travel ends at {:g} mm", trip.value,
                         trip.limit);
  }
  return "";
}

std::string_view advice(Kind kind) {
  switch (kind) {
    case Kind::kTrackingError:
      return "does the axis move freely, do [servo] and [safety] fit?";
    case Kind::kPositiveLimit:
    case Kind::kNegativeLimit:
      return "drive the axis off the switch, check [limits] and the wire";
    case Kind::kDriveAlarm:
      return "read the alarm on the drive and remove its cause";
    case Kind::kReadyLost:
    case Kind::kNotReady:
      return "is the drive's main power on, is its /S-RDY wired?";
    case Kind::kEncoderFrozen:
      return "check encoder cable and counter, or whether the axis is blocked";
    case Kind::kRunaway:
      return "check the signs of V-REF and encoder";
    case Kind::kCountStep:
      return "check encoder cable, shield and counter";
    case Kind::kSaturation:
      return "lower the feedrate or check the V-REF scale";
    case Kind::kLatePeriods:
    case Kind::kStall:
      return "use a longer period, a free CPU or a real-time kernel, see [realtime]";
    case Kind::kSamplesLost:
      return "is the disk slow or full?";
    case Kind::kServoFailed:
      return "it must return a finite number of volts for each axis";
    case Kind::kOutsideTravel:
      return "it was not sent; this is an error of the planner, please report the program";
  }
  return "";
}

}  // namespace

Reaction reaction_to(Kind kind) noexcept {
  switch (kind) {
    case Kind::kSaturation:
    case Kind::kLatePeriods:
    case Kind::kStall:
    case Kind::kSamplesLost:
      return Reaction::kControlled;
    default:
      return Reaction::kImmediate;
  }
}

std::string describe(const Trip& trip, const std::string& advice_instead) {
  const std::string axis = trip.axis == kNoAxis ? "" : fmt::format("axis {}: ", "xy?z"[trip.axis]);
  const std::string place = trip.line == 0
                                ? "before the first set point"
                                : fmt::format("at t = {:.3f} s, NC line {}", trip.time, trip.line);
  const std::string_view done =
      is_immediate(trip) ? "0 V and servo off at once" : "stopped on the path";
  return fmt::format("{}{}, {}; {}; {}", axis, measure(trip), place, done,
                     advice_instead.empty() ? advice(trip.kind) : advice_instead);
}

}  // namespace twin::motion

#include "config/rules.hpp"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace twin::config {
namespace {

/// A setting that the certified planner does not have.
struct PaperOnly {
  std::string path;
  std::string_view value;
};

std::vector<PaperOnly> paper_only_settings(const MachineFile& machine) {
  std::vector<PaperOnly> found;
  if (machine.path.curves != CurveKind::kNurbs) {
    found.push_back({"path.curves", kCurveNames[static_cast<std::size_t>(machine.path.curves)]});
  }
  if (machine.planning.acceleration_profile != AccelerationProfile::kTrapezoidal) {
    found.push_back(
        {"planning.acceleration_profile",
         machine.planning.acceleration_profile == AccelerationProfile::kFir ? "fir" : "s_curve"});
  }
  if (machine.planning.feedrate_rule == FeedrateRule::kConstant) {
    found.push_back({"planning.feedrate_rule", "constant"});
  }
  if (machine.planning.feedrate_rule == FeedrateRule::kContactSpeed) {
    found.push_back({"planning.feedrate_rule", "contact_speed"});
  }
  return found;
}

using hal::rig::AxisWiring;

/// A channel and the key that claims it.
struct Claim {
  std::string key;
  int channel;  ///< -1: none
};

Expected<void> check_distinct(const std::string& what, const std::vector<Claim>& claims) {
  std::map<int, std::string> owners;
  for (const Claim& claim : claims) {
    if (claim.channel < 0) {
      continue;
    }
    const auto [owner, is_new] = owners.emplace(claim.channel, claim.key);
    if (!is_new) {
      return fail(ErrorCode::kFile, fmt::format("{} and {} are both {} {}", owner->second,
                                                claim.key, what, claim.channel));
    }
  }
  return {};
}

/// Checks that no converter, counter, digital line or analogue input of the rig is used twice and
/// that the reset register is a whole one. @returns kFile error with the keys and the channel
Expected<void> check_rig_rules(const hal::rig::RigSettings& rig) {
  std::vector<Claim> dacs, counters, outputs, inputs, analogue;
  for (std::size_t i = 0; i < hal::kServoAxes; ++i) {
    const AxisWiring& a = rig.axis[i];
    const std::string section = i == hal::kX ? "rig.x." : "rig.y.";
    dacs.push_back({section + "dac", a.dac});
    counters.push_back({section + "counter", a.counter});
    outputs.push_back({section + "servo_on_do", a.servo_on.channel});
    outputs.push_back({section + "alarm_reset_do", a.alarm_reset.channel});
    inputs.push_back({section + "alarm_di", a.alarm.channel});
    inputs.push_back({section + "ready_di", a.ready.channel});
    inputs.push_back({section + "limit_positive_di", a.limit_positive.channel});
    inputs.push_back({section + "limit_negative_di", a.limit_negative.channel});
    analogue.push_back({section + "vref_readback_ai", a.vref_readback});
  }
  if (rig.counter_reset_offset % 4 != 0) {
    return fail(ErrorCode::kFile, fmt::format("rig.counter_reset_offset = {} is no multiple of 4",
                                              rig.counter_reset_offset));
  }
  return check_distinct("analogue output", dacs)
      .and_then([&] { return check_distinct("counter", counters); })
      .and_then([&] { return check_distinct("digital output", outputs); })
      .and_then([&] { return check_distinct("digital input", inputs); })
      .and_then([&] { return check_distinct("analogue input", analogue); });
}

/// Only the certified planner bounds the jerk as a vector.
Expected<void> check_jerk(const MachineFile& machine) {
  if (machine.path.planner == Planner::kPaper && machine.limits.jerk_of == JerkOf::kVector) {
    return fail(ErrorCode::kUsage,
                "limits.jerk_of = vector, but planning.planner = paper bounds the jerk along the "
                "path only: take planning.planner = certified, or limits.jerk_of = path");
  }
  return {};
}

/// Refuses a limit of a single axis that forbids the axis to move, or all but does.
///
/// Three times 0 is a machine without limits of single axes. A 0 beside a limit is one that was
/// left out: x and y are the table's axes, and every program moves them. z lifts the pen and may
/// be left out.
///
/// @param least  as for the limit of the whole path, in the unit of the key, of which `scale` are
///               a base unit
Expected<void> check_axis_limit(std::string_view key, const Vec3& limit, double scale,
                                double least) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double value = scale * limit[i];
    if (value == 0.0 && i < 2 && !limit.isZero(0.0)) {
      return fail(
          ErrorCode::kFile,
          fmt::format("limits.{} is [{:g}, {:g}, {:g}], 0 in {}, an axis that must move: "
                      "give it a limit of at least {:g}, or leave all three at 0, which is "
                      "no limits of single axes",
                      key, scale * limit[0], scale * limit[1], scale * limit[2], "xyz"[i], least));
    }
    if (value > 0.0 && value < least) {
      return fail(ErrorCode::kFile,
                  fmt::format("limits.{} is {:g} in {}: expected 0, which is no limit of its own, "
                              "or at least {:g}",
                              key, value, "xyz"[i], least));
    }
  }
  return {};
}

Expected<void> check_axis_limits(const Limits& limits) {
  return check_axis_limit("axis_feedrate_mm_per_min", limits.axis_feedrate,
                          units::mm_per_min_from_mm_per_s(1.0), 1.0)
      .and_then([&] {
        return check_axis_limit("axis_acceleration_mm_per_s2", limits.axis_acceleration, 1.0, 1.0);
      })
      .and_then(
          [&] { return check_axis_limit("axis_jerk_mm_per_s3", limits.axis_jerk, 1.0, 1.0); });
}

/// The paper's planner knows limits along the path only.
void note_axis_limits(MachineFile& machine) {
  const Limits& l = machine.limits;
  if (machine.path.planner == Planner::kPaper &&
      !(l.axis_feedrate.isZero(0.0) && l.axis_acceleration.isZero(0.0) &&
        l.axis_jerk.isZero(0.0))) {
    machine.add_note(
        "planning.planner = paper does not keep limits.axis_feedrate, "
        "axis_acceleration, axis_jerk");
  }
}

}  // namespace

Expected<void> resolve_planner(MachineFile& machine, const std::set<std::string>& given) {
  if (machine.path.planner != Planner::kCertified) {
    note_axis_limits(machine);
    return check_jerk(machine);
  }
  for (const PaperOnly& setting : paper_only_settings(machine)) {
    if (given.contains("planning.planner") && given.contains(setting.path)) {
      return fail(ErrorCode::kUsage,
                  fmt::format("planning.planner = certified does not have {} = {}, only paper has "
                              "it: leave one of them out",
                              setting.path, setting.value));
    }
    machine.path.planner = Planner::kPaper;
    machine.add_note(
        fmt::format("planning.planner = paper, because {} = {}", setting.path, setting.value));
  }
  note_axis_limits(machine);
  return check_jerk(machine);
}

Expected<void> check_rules(const MachineFile& machine) {
  const Limits& l = machine.limits;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!(l.travel_min[i] < l.travel_max[i])) {
      return fail(ErrorCode::kFile,
                  fmt::format("limits.travel_min_mm is {:g} and travel_max_mm is {:g} mm in {}: "
                              "the lower end must be below the upper",
                              l.travel_min[i], l.travel_max[i], "xyz"[i]));
    }
  }
  TWIN_CHECK(check_axis_limits(l));
  const std::string& ignored = machine.program.ignored_axes;
  if (ignored.find_first_not_of("ABCEUVWabceuvw") != std::string::npos) {
    return fail(ErrorCode::kFile, fmt::format("program.ignored_axes is '{}': expected letters of A "
                                              "B C E U V W",
                                              ignored));
  }
  if (machine.path.min_segments > machine.path.max_segments) {
    return fail(ErrorCode::kFile,
                fmt::format("planning.min_segments = {} is more than planning.max_segments = {}",
                            machine.path.min_segments, machine.path.max_segments));
  }
  return check_rig_rules(machine.rig);
}

}  // namespace twin::config

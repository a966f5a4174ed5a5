#include "config/rules.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "config/rig_rules.hpp"

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

}  // namespace

Expected<void> resolve_planner(MachineFile& machine, const std::set<std::string>& given) {
  if (machine.path.planner != Planner::kCertified) {
    return {};
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
  return {};
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
  if (machine.path.min_segments > machine.path.max_segments) {
    return fail(ErrorCode::kFile,
                fmt::format("planning.min_segments = {} is more than planning.max_segments = {}",
                            machine.path.min_segments, machine.path.max_segments));
  }
  return check_rig_rules(machine.rig);
}

}  // namespace twin::config

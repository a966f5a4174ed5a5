#include "tests/fuzz/chain/known_defects.hpp"

#include <algorithm>
#include <cstdlib>

namespace twin::fuzz {
namespace {

bool is_paper(const Case& made) { return made.machine.path.planner == Planner::kPaper; }

bool has_axis_limits(const Case& made) {
  const Limits& limits = made.machine.limits;
  return !is_paper(made) &&
         (limits.axis_feedrate.any() || limits.axis_acceleration.any() || limits.axis_jerk.any());
}

bool is_acceleration(Measure measure) {
  return measure == Measure::kVectorAcceleration || measure == Measure::kRawTangential ||
         measure == Measure::kRawNormal || measure == Measure::kTangential ||
         measure == Measure::kAxisAcceleration;
}

bool is_jerk(Measure measure) {
  return measure == Measure::kRawJerk || measure == Measure::kJerk || measure == Measure::kAxisJerk;
}

struct KnownDefect {
  std::string_view name;
  bool (*explains)(const Case& made, Measure measure, double share);
};

constexpr KnownDefect kKnown[] = {
    {"braking and changes of the override exceed everything with limits of single axes",
     [](const Case& made, Measure measure, double) {
       return has_axis_limits(made) && !made.operations.empty() &&
              (is_acceleration(measure) || is_jerk(measure) || measure == Measure::kPassed);
     }},
    {"with limits of single axes the plan is slower than stopping",
     [](const Case& made, Measure measure, double) {
       return has_axis_limits(made) && measure == Measure::kTime;
     }},
    {"the paper's planner misses peaks of the curvature of sharply bent NURBS between its samples",
     [](const Case& made, Measure measure, double share) {
       return is_paper(made) &&
              (measure == Measure::kRawNormal || measure == Measure::kVectorAcceleration) &&
              share < 1.05;
     }},
    {"the paper's planner is slow on curves that it fits through specks beside long blocks",
     [](const Case& made, Measure measure, double share) {
       return is_paper(made) && measure == Measure::kTime && share < 1.4;
     }},
    {"the certified planner: some per cent too much at corners and after a change of the override",
     [](const Case& made, Measure measure, double share) {
       return !is_paper(made) &&
              ((is_acceleration(measure) && share < 1.3) || (is_jerk(measure) && share < 1.8));
     }},
    {"the certified planner: some per cent slower than stopping",
     [](const Case& made, Measure measure, double share) {
       return !is_paper(made) && measure == Measure::kTime && share < 1.25;
     }},
};

bool has_filters() {
  static const bool has = std::getenv("TWIN_FUZZ_KNOWN") == nullptr;
  return has;
}

}  // namespace

void pass_by_known_defects(Case& made) {
  if (!has_filters()) {
    return;
  }
  Limits& limits = made.machine.limits;
  // Planning with limits of single axes may not end (feedrate/certified), and exceeds the jerk of
  // axes where the curvature of a spline of degree 2 jumps.
  if (has_axis_limits(made)) {
    limits.axis_feedrate.setZero();
    limits.axis_acceleration.setZero();
    limits.axis_jerk.setZero();
  }
  // Ascents that reach A in less than a microsecond may not end either.
  if (!is_paper(made)) {
    limits.jerk = std::min(limits.jerk, 1e5 * limits.acceleration);
  }
}

bool is_known_to_crawl(const Case& made) { return has_filters() && has_axis_limits(made); }

std::string_view known_defect(const Case& made, Measure measure, double share) {
  for (const KnownDefect& defect : kKnown) {
    if (has_filters() && defect.explains(made, measure, share)) {
      return defect.name;
    }
  }
  return {};
}

}  // namespace twin::fuzz

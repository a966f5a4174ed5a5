#include "tests/fuzz/chain/known_defects.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace twin::fuzz {
namespace {

bool is_paper(const Case& made) { return made.machine.path.planner == Planner::kPaper; }

/// Third differences of places that are known to a nanometre [mm].
constexpr double kKnownPlace = 1e-9;

struct KnownDefect {
  std::string_view name;
  bool (*explains)(const Case& made, Measure measure, double share);
};

constexpr KnownDefect kKnown[] = {
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
    {"the certified planner: way that is hidden from set points where a fitted path winds in a "
     "period",
     [](const Case& made, Measure measure, double share) {
       return !is_paper(made) && measure == Measure::kJerk && share < 1.2;
     }},
    {"the certified planner: the jerk of an axis is a nanometre in a period cubed or less",
     [](const Case& made, Measure measure, double share) {
       return !is_paper(made) && measure == Measure::kAxisJerk && share < 1.2 &&
              made.machine.limits.axis_jerk.maxCoeff() * std::pow(made.machine.period, 3) <
                  2.0 * kKnownPlace;
     }},
    {"the certified planner: corners of which bump and stop are estimated to take the same time",
     [](const Case& made, Measure measure, double share) {
       return !is_paper(made) && measure == Measure::kTime && share < 1.03;
     }},
};

bool has_filters() {
  static const bool has = std::getenv("TWIN_FUZZ_KNOWN") == nullptr;
  return has;
}

}  // namespace

std::string_view known_defect(const Case& made, Measure measure, double share) {
  for (const KnownDefect& defect : kKnown) {
    if (has_filters() && defect.explains(made, measure, share)) {
      return defect.name;
    }
  }
  return {};
}

}  // namespace twin::fuzz

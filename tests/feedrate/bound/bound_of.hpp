#pragma once

#include <vector>

#include "feedrate/bound/time_bound.hpp"
#include "tests/support/plan.hpp"

namespace twin::test {

/// Place of the bound's profile.
struct At {
  double s;  ///< [mm]
  double v;  ///< [mm/s]
};

/// Bound of a plan [s].
inline double bound_of(const Plan& plan, const PlanSettings& settings = {},
                       std::vector<At>* profile = nullptr) {
  feedrate::TimeBound::Profile record;
  if (profile != nullptr) {
    record = [profile](double s, double v) { profile->push_back({s, v}); };
  }
  feedrate::TimeBound bound(settings.limits, settings.model, settings.path, settings.period,
                            record);
  for (const feedrate::PlannedSegment& planned : plan.segments) {
    bound.add(planned);
  }
  return bound.finish();
}

inline double bound_of(const std::vector<gcode::Block>& blocks, const PlanSettings& settings = {},
                       std::vector<At>* profile = nullptr) {
  return bound_of(plan(blocks, settings), settings, profile);
}

/// Bounds of a plan without and with the limit of jerk [s].
struct Bounds {
  double without_jerk;
  double with_jerk;
};

inline Bounds bounds_of(const Plan& plan, const PlanSettings& settings = {}) {
  feedrate::TimeBound bound(settings.limits, settings.model, settings.path, settings.period);
  for (const feedrate::PlannedSegment& planned : plan.segments) {
    bound.add(planned);
  }
  const double without_jerk = bound.finish();
  return {without_jerk, bound.with_jerk()};
}

}  // namespace twin::test

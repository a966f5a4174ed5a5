#pragma once

#include <vector>

#include "feedrate/look_ahead.hpp"
#include "gcode/block.hpp"
#include "path/segment.hpp"

namespace twin::test {

struct Plan {
  std::vector<feedrate::PlannedSegment> segments;
  std::int64_t fallbacks = 0;
  double time = 0.0;  ///< sum of all phases [s]
};

struct PlanSettings {
  int look_ahead = 200;
  double period = 1e-3;  ///< [s]
  Limits limits;
  PlanningModel model;
  PathSettings path;  ///< all but its look-ahead
};

Plan plan(const std::vector<path::Segment>& segments, const PlanSettings& settings = {});
/// The same for blocks, through the path builder.
Plan plan(const std::vector<gcode::Block>& blocks, const PlanSettings& settings = {});

/// Fails unless the phases cover every segment exactly, join in feedrate and acceleration, keep A,
/// J, the zones and (unless the rule is `constant`) the normal acceleration, rest where they must
/// and dwell as long as they must.
void expect_whole(const Plan& plan, const Limits& limits, bool keeps_normal_acceleration = true);

}  // namespace twin::test

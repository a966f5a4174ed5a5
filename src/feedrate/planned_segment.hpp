#pragma once

#include <cstdint>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/stop.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// A segment with its feedrate: what the planning thread hands to the motion thread.
struct PlannedSegment {
  path::Segment segment;
  std::int64_t index = 0;         ///< counted from 0
  std::int64_t plan = 0;          ///< number of the plan that it comes from, counted from 0
  std::vector<Phase> phases;      ///< cover [0, segment.length]; s from the segment's start
  std::vector<LimitZone> limits;  ///< feedrate limits, s from the segment's start
  /// The stretches that it lies on, for a stop; s from the segment's start, and the last one may
  /// end beyond it. Empty: every place allows the acceleration and jerk of the machine.
  std::vector<Stretch> stretches;
};

}  // namespace twin::feedrate

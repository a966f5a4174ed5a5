#pragma once

#include <cstdint>
#include <vector>

#include "feedrate/limits/limit_zone.hpp"
#include "feedrate/profile/phase.hpp"
#include "feedrate/profile/ramp_limits.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// A segment with its feedrate: what the planning thread hands to the motion thread.
struct PlannedSegment {
  path::Segment segment;
  std::int64_t index = 0;         ///< counted from 0
  std::int64_t plan = 0;          ///< plan of the path that it is of, counted from 0
  std::vector<Phase> phases;      ///< cover [0, segment.length]; s from the segment's start
  std::vector<LimitZone> limits;  ///< feedrate limits, s from the segment's start
  RampLimits brake;               ///< with which it may brake from here until it rests
};

}  // namespace twin::feedrate

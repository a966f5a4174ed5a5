#pragma once

#include <vector>

#include "feedrate/limits/feedrate_rule.hpp"
#include "feedrate/limits/limit_zone.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Appends the feedrate limits inside one segment that begins at s0: where the curvature is, not
/// over the whole curve.
///
/// A line has one zone, an arc one, a curve as many as its curvature needs: neighbouring zones
/// whose limits differ by less than 1 % become one, with the lower limit. So has an arc that is not
/// in the XY plane, where the rule depends on the heading.
///
/// @param s0        place of the segment's start [mm]
/// @param feedrate  asked for on it, its programmed feedrate unless that is overridden [mm/s]
void append_segment_limits(const path::Segment& segment, double s0, double feedrate,
                           const FeedrateRules& rules, std::vector<LimitZone>& zones);

/// Largest curvature of a segment near one of its ends, within a distance [1/mm].
double curvature_near_end(const path::Segment& segment, bool at_end, double distance);

}  // namespace twin::feedrate

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "feedrate/limits/feedrate_rules.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Stretch of the path with one feedrate limit; begin == end is a single place, such as a corner.
struct LimitZone {
  double begin = 0.0;                                             ///< distance along the path [mm]
  double end = 0.0;                                               ///< >= begin [mm]
  double limit = 0.0;                                             ///< [mm/s]
  double acceleration = std::numeric_limits<double>::infinity();  ///< tangential [mm/s^2]
  double jerk = std::numeric_limits<double>::infinity();          ///< tangential [mm/s^3]
};

/// Appends the zones of one segment in a row. Neighbours whose limits differ by less than 1 %
/// become one zone, with the lowest limits of all of them.
class ZoneRow {
 public:
  /// @param zones  get the zones; those that are there already stay as they are
  explicit ZoneRow(std::vector<LimitZone>& zones) : zones_(zones), first_(zones.size()) {}

  /// Appends a zone that begins where the last one ends, or widens that one.
  void append(const LimitZone& zone);

  bool is_empty() const noexcept { return zones_.size() == first_; }
  LimitZone& last() noexcept { return zones_.back(); }

  /// Lowers the limit of the last zone, and of what it is made of [mm/s].
  void lower_last(double limit) noexcept;

 private:
  std::vector<LimitZone>& zones_;
  std::size_t first_;
  double highest_ = 0.0;  // limit of the zones that became the last one [mm/s]
};

/// Appends the feedrate limits inside one segment that begins at s0, at the samples of its
/// curvature: so a curve is slow where it bends, not over its whole length.
///
/// A line has one zone, an arc one, a curve as many as its curvature needs (ZoneRow). An arc that
/// is not in the XY plane has several as well where the rule depends on the heading.
///
/// @param s0        place of the segment's start [mm]
/// @param feedrate  asked for on it, its programmed feedrate unless that is overridden [mm/s]
void append_segment_limits(const path::Segment& segment, double s0, double feedrate,
                           const FeedrateRules& rules, std::vector<LimitZone>& zones);

/// One of the two ends of a segment.
enum class SegmentEnd : std::uint8_t { kBegin, kEnd };

/// Largest curvature of a segment within a distance from one of its ends [1/mm].
double curvature_near(SegmentEnd which, const path::Segment& segment, double distance);

}  // namespace twin::feedrate

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "feedrate/limits/feedrate_rules.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// A part of the path with one feedrate limit. A single place such as a corner has begin == end.
struct LimitZone {
  double begin = 0.0;                                             ///< distance along the path [mm]
  double end = 0.0;                                               ///< >= begin [mm]
  double limit = 0.0;                                             ///< [mm/s]
  double acceleration = std::numeric_limits<double>::infinity();  ///< tangential [mm/s^2]
  double deceleration = std::numeric_limits<double>::infinity();  ///< the same where a < 0 [mm/s^2]
  double jerk = std::numeric_limits<double>::infinity();          ///< tangential [mm/s^3]
  /// Above this feedrate the zone is passed without acceleration: the passage of a corner [mm/s].
  double held_above = std::numeric_limits<double>::infinity();
  // More acceleration is allowed below the limit, see ramp_levels.hpp. most = 0: no more.
  double most = 0.0;       ///< M, near rest, either way [mm/s^2]
  double bend = 0.0;       ///< S, share of M that the bend takes, over v^2 [s^2/mm^2]
  double power = 0.0;      ///< P, of acceleration and feedrate near rest [mm^2/s^3]
  double fade_up = 0.0;    ///< R, share of P that the bend takes, over v^3; a > 0 [s^3/mm^3]
  double fade_down = 0.0;  ///< the same where a < 0 [s^3/mm^3]
};

/// Whether a zone is the passage of a corner.
inline bool is_passage(const LimitZone& zone) noexcept {
  return zone.held_above < std::numeric_limits<double>::infinity();
}

/// Whether two zones allow the same tangential acceleration and jerk.
bool has_same_ramp(const LimitZone& a, const LimitZone& b) noexcept;

/// Which neighbours become one zone, which has the lowest limit of all of them.
struct ZoneMerging {
  /// Neighbours that allow the same ramps: where their limits differ by no more than this ratio [-].
  double same = 1.01;
  /// Neighbours that are passed together in no more than this time, where their limits differ by
  /// less than 30 %. Of the ramps that they allow the least counts [s].
  double brief = 0.0;
};

/// Appends the zones of one segment, one after the other, and merges neighbours.
class ZoneRow {
 public:
  /// @param zones  the list to append to; its present zones are not changed
  explicit ZoneRow(std::vector<LimitZone>& zones, const ZoneMerging& merging = {})
      : zones_(zones), first_(zones.size()), merging_(merging) {}

  /// Appends a zone that begins where the last one ends, or merges it with the last one.
  void append(const LimitZone& zone);

  bool is_empty() const noexcept { return zones_.size() == first_; }

 private:
  std::vector<LimitZone>& zones_;
  std::size_t first_;
  ZoneMerging merging_;
  double highest_ = 0.0;  // highest limit among the zones that were merged into the last one [mm/s]
};

/// Appends the feedrate limits inside one segment. A curve gets a limit at each sample of its
/// curvature, so it is slow where it bends, not over its whole length.
///
/// A line and an arc have one zone each, a curve as many as its curvature needs (ZoneRow). If the
/// rule depends on the heading, an arc that is not in the XY plane has several zones, too.
///
/// @param s0        distance of the segment's start along the path [mm]
/// @param feedrate  feedrate asked for on the segment: the programmed one, with override [mm/s]
void append_segment_limits(const path::Segment& segment, double s0, double feedrate,
                           const FeedrateRules& rules, std::vector<LimitZone>& zones);

/// One of the two ends of a segment.
enum class SegmentEnd : std::uint8_t { kBegin, kEnd };

/// Largest curvature of a segment within a distance from one of its ends [1/mm].
double curvature_near(SegmentEnd which, const path::Segment& segment, double distance);

}  // namespace twin::feedrate

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "feedrate/profile/phases.hpp"
#include "motion/interpolator/interpolator.hpp"

namespace twin::runtime {

/// The phases of one planned segment.
struct SegmentPhases {
  std::int64_t index = 0;  ///< of the segment
  double length = 0.0;     ///< of the segment [mm]
  std::vector<feedrate::Phase> phases;
};

/// A place this close to a segment's end is its end [mm].
inline constexpr double kSegmentEnd = 1e-6;

/// A place of a plan without tangential acceleration, where another plan may go on.
struct SwitchPlace {
  std::int64_t segment = 0;  ///< in which the present plan ends there
  std::size_t phase = 0;     ///< its last phase of this segment
  double time = 0.0;         ///< into this phase [s]
  bool is_at_end = false;    ///< at the segment's end: the other plan starts in the next segment
  double s = 0.0;            ///< from the segment's start [mm]
  double v = 0.0;            ///< [mm/s]
  double after = 0.0;        ///< time of motion until there [s]
};

/// The first such place at least `margin` after another one.
///
/// In a phase of constant jerk the acceleration vanishes at t = -a / j. In a phase of constant
/// feedrate it is zero throughout, so the place is exactly at the margin. A rest has such a place
/// at its end only.
///
/// @param plan       successive segments, the one of `from` among them
/// @param margin     least time of motion from `from` on [s]
/// @param tolerance  largest tangential acceleration that counts as zero [mm/s^2]
/// @returns nothing where the plan known so far has no such place
std::optional<SwitchPlace> find_switch_place(const std::deque<SegmentPhases>& plan,
                                             const motion::PlanPlace& from, double margin,
                                             double tolerance);

}  // namespace twin::runtime

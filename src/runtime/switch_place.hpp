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
  std::int64_t index = 0;  ///< index of the segment
  double length = 0.0;     ///< length of the segment [mm]
  std::vector<feedrate::Phase> phases;
};

/// A place closer than this to the end of a segment is taken as the end [mm]. A motion that goes on
/// from there leaves out the rest, as a step that no plan knows of: ten times as much would be seen
/// as jerk at short periods.
inline constexpr double kSegmentEnd = 1e-9;

/// A place of a plan without tangential acceleration, where another plan may take over.
struct SwitchPlace {
  std::int64_t segment = 0;  ///< index of the segment in which the present plan is left
  std::size_t phase = 0;     ///< index of the last phase of this segment that is followed
  double time = 0.0;         ///< time since the begin of this phase [s]
  bool is_at_end = false;    ///< at the segment's end: the other plan starts in the next segment
  double s = 0.0;            ///< distance from the start of the segment [mm]
  double v = 0.0;            ///< feedrate [mm/s]
  double after = 0.0;        ///< time of motion until there [s]
};

/// Finds the first place without tangential acceleration at least `margin` after a given place.
///
/// In a phase of constant jerk the acceleration vanishes at t = -a / j. In a phase of constant
/// feedrate it is zero throughout, so the place is exactly at the margin. In a dwell only the end
/// is such a place.
///
/// @param plan       successive segments, which include that of `from`
/// @param from       where the motion is
/// @param margin     least time of motion from `from` to the result [s]
/// @param tolerance  largest tangential acceleration that counts as zero [mm/s^2]
/// @returns nothing if the part of the plan that is known has no such place
std::optional<SwitchPlace> find_switch_place(const std::deque<SegmentPhases>& plan,
                                             const motion::PlanPlace& from, double margin,
                                             double tolerance);

}  // namespace twin::runtime

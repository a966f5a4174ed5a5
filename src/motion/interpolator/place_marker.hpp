#pragma once

#include <cstddef>
#include <cstdint>

#include "feedrate/planned_segment.hpp"
#include "motion/interpolator/curve_follower.hpp"
#include "motion/interpolator/phase_clock.hpp"
#include "motion/interpolator/set_point.hpp"
#include "motion/motion_settings.hpp"

namespace twin::motion {

/// Turns instants of the motion along the path into set points in space. The instants come in the
/// order of the path.
class PlaceMarker {
 public:
  explicit PlaceMarker(ParameterUpdate update) : follower_(update) {}

  /// The set point of an instant on a segment. Real-time safe. @param period [s]
  void mark(const feedrate::PlannedSegment& segment, const PathInstant& instant, double period,
            SetPoint& out) noexcept;

 private:
  void enter(const feedrate::PlannedSegment& segment) noexcept;
  path::PathPoint locate(const path::Segment& segment, const PathInstant& instant,
                         double period) noexcept;
  void look_up(const feedrate::PlannedSegment& segment, double s, SetPoint& out) noexcept;

  std::int64_t index_ = -1;  // of the segment of the last instant
  std::int64_t plan_ = -1;   // of the same
  std::size_t block_ = 0;    // of this segment
  std::size_t zone_ = 0;     // limit zone of this segment
  CurveFollower follower_;
};

}  // namespace twin::motion

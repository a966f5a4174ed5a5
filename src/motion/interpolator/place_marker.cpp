#include "motion/interpolator/place_marker.hpp"

#include <variant>

namespace twin::motion {

/// Begins anew where the segment is another one, or the same one in another plan.
void PlaceMarker::enter(const feedrate::PlannedSegment& segment) noexcept {
  if (segment.index == index_ && segment.plan == plan_) {
    return;
  }
  zone_ = 0;
  plan_ = segment.plan;
  if (segment.index == index_) {
    return;
  }
  index_ = segment.index;
  block_ = 0;
  const auto& phases = segment.phases;
  follower_.enter(phases.empty() ? feedrate::PathMotion{} : feedrate::motion_at(phases[0], 0.0));
}

path::PathPoint PlaceMarker::locate(const path::Segment& segment, const PathInstant& instant,
                                    double period) noexcept {
  const feedrate::PathMotion& m = instant.motion;
  if (const auto* line = std::get_if<path::Line>(&segment.geometry)) {
    return path::point_at(*line, m.s);
  }
  if (const auto* arc = std::get_if<path::Arc>(&segment.geometry)) {
    return path::point_at(*arc, m.s);
  }
  const auto* fitted = std::get_if<path::FittedCurve>(&segment.geometry);
  if (fitted == nullptr) {
    return segment.begin;
  }
  if (instant.is_curve_end) {
    return segment.end;
  }
  const auto basis =
      instant.is_braking ? CurveFollower::Basis::kArcLength : CurveFollower::Basis::kUpdate;
  return follower_.follow(*fitted, m, instant.elapsed, period, basis);
}

void PlaceMarker::mark(const feedrate::PlannedSegment& segment, const PathInstant& instant,
                       double period, SetPoint& out) noexcept {
  enter(segment);
  const feedrate::PathMotion& m = instant.motion;
  if (const auto* passage = std::get_if<path::CornerMotion>(&segment.segment.geometry)) {
    const path::SpaceMotion at = path::motion_in(*passage, m.s, m.v, m.a);
    out.position = at.position;
    out.velocity = at.velocity;
    out.acceleration = at.acceleration;
    out.feedrate = at.velocity.norm();
    look_up(segment, m.s, out);
    return;
  }
  const path::PathPoint at = locate(segment.segment, instant, period);
  out.position = at.position;
  out.velocity = m.v * at.tangent;
  out.acceleration = m.a * at.tangent + m.v * m.v * at.curvature;
  out.feedrate = m.v;
  look_up(segment, m.s, out);
}

/// Block, line and feedrate limit of a place.
void PlaceMarker::look_up(const feedrate::PlannedSegment& segment, double s,
                          SetPoint& out) noexcept {
  const auto& marks = segment.segment.marks;
  while (block_ + 1 < marks.size() && s > marks[block_].end) {
    ++block_;
  }
  const auto& zones = segment.limits;
  while (zone_ + 1 < zones.size() && s > zones[zone_].end) {
    ++zone_;
  }
  out.segment = segment.index;
  out.block = marks.empty() ? 0 : marks[block_].block;
  out.line = marks.empty() ? 0 : marks[block_].line;
  out.feedrate_limit = zones.empty() ? 0.0 : zones[zone_].limit;
}

}  // namespace twin::motion

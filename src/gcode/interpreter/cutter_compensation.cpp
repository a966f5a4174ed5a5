#include "gcode/interpreter/cutter_compensation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;
constexpr double kReversal = 1e-9;  // from half a turn, for a corner to be one [rad]
constexpr double kSpeck = 1e-6;     // what may be missing of a piece by rounding [mm]

tl::unexpected<Error> gouge(const Block& block) {
  return fail_at(0, fmt::format("the cutter would gouge the contour between the lines {} and the "
                                "one before it: expected a smaller cutter or a wider corner",
                                block.line));
}

tl::unexpected<Error> too_many() {
  return fail_at(0,
                 fmt::format("more than {} moves across the plane and rests between two moves of "
                             "the cutter compensation",
                             CutterCompensation::kMostBetween));
}

Vec3 moved(const Vec3& place, const Vec2& to, const PlaneAxes& axes) {
  Vec3 result = place;
  result[axes.first] = to.x();
  result[axes.second] = to.y();
  return result;
}

/// Angle from one direction to another in a sense, from 0 up to a whole turn.
double angle_between(const Vec2& from, const Vec2& to, double sense) {
  const double angle = std::atan2(sense * cross(from, to), from.dot(to));
  return angle < 0.0 ? angle + kWholeTurn : angle;
}

geometry::Arc arc_about(const Vec3& start, const Vec2& centre, const Vec2& end, double turn,
                        double sweep, double rise, const PlaneAxes& axes) {
  geometry::Arc arc;
  const Vec2 out = in_plane(start, axes) - centre;
  arc.centre = moved(start, centre, axes);
  arc.radius = out.norm();
  arc.e1 = in_space(out / arc.radius, axes);
  arc.e2 = in_space(turn * Vec2(-out.y(), out.x()) / arc.radius, axes);
  arc.radius_change = (end - centre).norm() - arc.radius;
  arc.sweep = sweep;
  arc.rise = turn * rise;
  return arc;
}

}  // namespace

void CutterCompensation::start(double distance, Plane plane) {
  is_on_ = true;
  distance_ = distance;
  axes_ = axes_of(plane);
  has_held_ = is_full_ = false;
  slack_ = kSpeck;
  between_.clear();
}

Expected<void> CutterCompensation::add(const Block& block, double feedrate) {
  if (is_full_) {
    return too_many();
  }
  feedrate_ = feedrate;
  const bool goes_along =
      block.motion == Motion::kArc ||
      (block.motion != Motion::kDwell &&
       (in_plane(block.end, axes_) - in_plane(block.start, axes_)).norm() > kNoLength);
  if (!goes_along) {
    if (!has_held_ && block.motion == Motion::kDwell) {
      ready_.push_back(block);
      return {};
    }
    if (!has_held_) {
      return fail_at(0,
                     "the first move of the cutter compensation is across its plane: expected "
                     "one along it, longer than the radius of the cutter");
    }
    is_full_ = between_.size() >= kMostBetween;
    if (is_full_) {
      return block.motion == Motion::kDwell ? Expected<void>{} : too_many();
    }
    between_.push_back(block);
    return {};
  }
  if (!has_held_) {
    return enter(block);
  }
  const OffsetSide next(block, axes_, distance_);
  if (!next.is_sound()) {
    return fail_at(0, fmt::format("the radius of the cutter, {:.6g} mm, is not less than that of "
                                  "the arc, {:.6g} mm, whose inside it is to cut",
                                  std::abs(distance_), block.arc.radius));
  }
  TWIN_CHECK(turn_corner(next, block));
  const Vec3 start = at_;
  held_ = block;
  held_.start = start;
  side_ = next;
  return {};
}

Expected<void> CutterCompensation::enter(const Block& block) {
  const double length = (in_plane(block.end, axes_) - in_plane(block.start, axes_)).norm();
  if (!(length > std::abs(distance_))) {
    return fail_at(0, fmt::format("the first move of the cutter compensation is {:.6g} mm long: "
                                  "expected more than the cutter's radius, {:.6g} mm",
                                  length, std::abs(distance_)));
  }
  held_ = block;
  side_ = OffsetSide(block, axes_, distance_);
  has_held_ = true;
  return side_.is_arc() ? bend_entry(block) : Expected<void>{};
}

/// The first piece as an arc: it goes through the cutter's place and ends beside the contour's end,
/// with the contour's tangent there. Its centre is E + k n, with n the normal at the end E and
///   |E + k n - S| = |k|,  k = |S - E|^2 / (2 n . (S - E)).
Expected<void> CutterCompensation::bend_entry(const Block& block) {
  const Vec2 start = in_plane(block.start, axes_);
  const Vec2 end = side_.last();
  const Vec2 normal(-side_.last_tangent().y(), side_.last_tangent().x());
  const Vec2 back = start - end;
  const double share = 2.0 * normal.dot(back);
  const double k = share == 0.0 ? 0.0 : back.squaredNorm() / share;
  if (!(k * side_.turn() > 0.0) || !side_.is_sound()) {
    return gouge(block);
  }
  const Vec2 centre = end + k * normal;
  side_.move_centre(centre, angle_between(start - centre, end - centre, side_.turn()));
  return {};
}

Expected<void> CutterCompensation::turn_corner(const OffsetSide& next, const Block& block) {
  const Vec2& before = side_.last_tangent();
  const Vec2& after = next.first_tangent();
  const double angle = std::atan2(cross(before, after), before.dot(after));
  const bool is_reversal = std::abs(angle) > std::numbers::pi - kReversal;
  const bool is_inside = angle * distance_ > 0.0 && !is_reversal;
  if (std::abs(angle) < kFlatCorner || distance_ == 0.0) {
    TWIN_CHECK(release(side_.last(), block));
    slack_ = kSpeck + kFlatCorner * std::abs(distance_);
    return {};
  }
  if (is_inside) {
    const auto meeting = meeting_point(side_, next);
    return meeting ? release(*meeting, block) : gouge(block);
  }
  if (!(feedrate_ > 0.0) && block.motion != Motion::kRapid) {
    return fail_at(0,
                   "the cutter goes round a corner on an arc, but no feedrate is in force: "
                   "expected an F word before it");
  }
  TWIN_CHECK(release(side_.last(), block));
  go_round(next, block);
  return {};
}

/// The arc about an outer corner, or before a rapid a straight line; the cutter is beside the corner's
/// beginning.
void CutterCompensation::go_round(const OffsetSide& next, const Block& block) {
  const double turn = distance_ > 0.0 ? -1.0 : 1.0;
  const Vec2 corner = in_plane(block.start, axes_);
  const Vec2 end = next.first();
  const double sweep = angle_between(in_plane(at_, axes_) - corner, end - corner, turn);
  Block arc = block;
  arc.start = at_;
  arc.end = moved(at_, end, axes_);
  if (block.motion != Motion::kRapid) {
    arc.motion = Motion::kArc;
    arc.feedrate = feedrate_;
    arc.arc = arc_about(arc.start, corner, end, turn, sweep, 0.0, axes_);
  }
  at_ = arc.end;
  ready_.push_back(std::move(arc));
}

/// Lets the piece held back end at a place in the plane, and what comes behind it.
Expected<void> CutterCompensation::release(const Vec2& end, const Block& reason) {
  const Vec2 start = in_plane(held_.start, axes_);
  const double rise = held_.end[axes_.third] - held_.start[axes_.third];
  held_.end = moved(held_.end, end, axes_);
  bool is_left = true;
  if (side_.is_arc()) {
    double sweep = angle_between(start - side_.centre(), end - side_.centre(), side_.turn());
    sweep += kWholeTurn * std::round((side_.sweep() - sweep) / kWholeTurn);
    const double radius = (start - side_.centre()).norm();
    if ((sweep - side_.sweep()) * radius > slack_ || sweep * radius < -slack_) {
      return gouge(reason);
    }
    held_.arc = arc_about(held_.start, side_.centre(), end, side_.turn(), sweep, rise, axes_);
    is_left = sweep * radius > kNoLength;
  } else {
    if ((end - start).dot(side_.last_tangent()) < -slack_) {
      return gouge(reason);
    }
    is_left = (held_.end - held_.start).norm() > kNoLength;
  }
  slack_ = kSpeck;
  at_ = is_left ? held_.end : held_.start;
  if (is_left) {
    ready_.push_back(held_);
  }
  for (Block& block : between_) {
    const Vec3 target = moved(block.end, end, axes_);
    block.start = at_;
    block.end = at_ = target;
    ready_.push_back(std::move(block));
  }
  between_.clear();
  return {};
}

Expected<Vec3> CutterCompensation::finish(const Vec3& place) {
  is_on_ = false;
  if (is_full_) {
    return too_many();
  }
  if (!has_held_) {
    return place;
  }
  has_held_ = false;
  TWIN_CHECK(release(side_.last(), held_));
  return at_;
}

void CutterCompensation::take_ready(std::vector<Block>& to) {
  for (Block& block : ready_) {
    to.push_back(std::move(block));
  }
  ready_.clear();
}

}  // namespace twin::gcode

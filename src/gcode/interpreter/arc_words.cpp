#include "gcode/interpreter/arc_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "gcode/block.hpp"
#include "gcode/interpreter/plane.hpp"
#include "gcode/text/fault.hpp"

namespace twin::gcode {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr double kMostSlack = 100.0;  // times the slack, however large the radius

double length(const Vec2& vector) { return std::hypot(vector.x(), vector.y()); }

/// The arc from the centre's place: u, d of (1) in the plane; radii already known to be sound.
ProgrammedArc make_arc(const ArcEnds& ends, const PlaneAxes& axes, const Vec2& u, const Vec2& d) {
  const double sense = ends.is_clockwise ? -1.0 : 1.0;
  const Vec2 v = u + d;
  ProgrammedArc arc;
  geometry::Arc& geometry = arc.geometry;
  geometry.radius = length(u);
  geometry.radius_change = length(v) - geometry.radius;
  geometry.centre = ends.start - in_space(u, axes);
  const Vec2 out = u / geometry.radius;
  geometry.e1 = in_space(out, axes);
  geometry.e2 = in_space(sense * Vec2(-out.y(), out.x()), axes);
  geometry.rise = sense * (ends.end[axes.third] - ends.start[axes.third]);
  arc.end = ends.end;

  const double turn = std::atan2(sense * cross(u, d), u.dot(v));
  if (std::abs(turn) * geometry.radius < kNoLength) {
    geometry.sweep = kFullTurn;
    geometry.radius_change = d.dot(out);
    arc.end = ends.start + in_space(geometry.radius_change * out, axes);
    arc.end[axes.third] = ends.end[axes.third];
  } else {
    geometry.sweep = turn > 0.0 ? turn : turn + kFullTurn;
  }
  return arc;
}

}  // namespace

Expected<ProgrammedArc> arc_by_offset(const ArcEnds& ends, const Vec3& offset, double slack) {
  const PlaneAxes axes = axes_of(ends.plane);
  const Vec2 u = -in_plane(offset, axes);
  const Vec2 d = in_plane(ends.end - ends.start, axes);
  const double start_radius = length(u);
  const double end_radius = length(u + d);
  if (start_radius < kNoLength || end_radius < kNoLength) {
    return fail_at(0, fmt::format("the centre of the arc is its {}: expected a radius above zero",
                                  start_radius < kNoLength ? "start" : "end"));
  }
  const double share = 1e-3 * std::max(start_radius, end_radius);
  if (std::abs(end_radius - start_radius) > std::clamp(share, slack, kMostSlack * slack)) {
    return fail_at(0, fmt::format("the arc's radius is {:.6g} mm at its start and {:.6g} mm at its "
                                  "end: expected the same within {:.3g} mm or 0.1 %{}",
                                  start_radius, end_radius, slack,
                                  share > kMostSlack * slack
                                      ? fmt::format(", {:.3g} mm at most", kMostSlack * slack)
                                      : std::string()));
  }
  return make_arc(ends, axes, u, d);
}

Expected<ProgrammedArc> arc_by_radius(const ArcEnds& ends, double radius) {
  const PlaneAxes axes = axes_of(ends.plane);
  const Vec2 d = in_plane(ends.end - ends.start, axes);
  const double chord = length(d);
  const double size = std::abs(radius);
  if (size < kNoLength) {
    return fail_at(0, "the arc's radius is zero: expected R other than zero");
  }
  if (chord < kNoLength) {
    return fail_at(0, "an arc with R from a point to itself has no centre: expected I J K");
  }
  if (chord / 2.0 - size > kRadiusSlack) {
    return fail_at(0, fmt::format("an arc of radius {:.6g} mm cannot span {:.6g} mm: expected R of "
                                  "at least {:.6g} mm",
                                  size, chord, chord / 2.0));
  }
  const double across = std::sqrt(std::max((size - chord / 2.0) * (size + chord / 2.0), 0.0));
  const double side = ends.is_clockwise == (radius < 0.0) ? across : -across;
  const Vec2 u = -(d / 2.0 + side / chord * Vec2(-d.y(), d.x()));
  return make_arc(ends, axes, u, d);
}

}  // namespace twin::gcode

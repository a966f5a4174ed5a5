#include "path/segment.hpp"

#include <utility>

namespace twin::path {
PathPoint point_at(const Line& line, double s) noexcept {
  return {line.start + s * line.direction, line.direction, Vec3::Zero()};
}

PathPoint point_at(const Arc& arc, double s) noexcept {
  const double fraction = fraction_at(arc.geometry, s, arc.length);
  const geometry::Derivatives at = derivatives_at(arc.geometry, fraction);
  const double pace = speed_at(arc.geometry, fraction);
  const Vec3 tangent = at.first / pace;
  return {at.position, tangent, (at.second - at.second.dot(tangent) * tangent) / (pace * pace)};
}

PathPoint point_from(const geometry::Derivatives& d) noexcept {
  const double pace = d.first.norm();
  const Vec3 tangent = pace > 0.0 ? Vec3(d.first / pace) : Vec3::UnitX();
  const Vec3 curvature = pace > 0.0
                             ? Vec3((d.second - d.second.dot(tangent) * tangent) / (pace * pace))
                             : Vec3::Zero();
  return {d.position, tangent, curvature};
}

Arc make_arc(const geometry::Arc& geometry) noexcept {
  return {geometry, length_to(geometry, 1.0)};
}

Arc part_of(const Arc& arc, double from, double to) noexcept {
  return make_arc(part_of(arc.geometry, fraction_at(arc.geometry, from, arc.length),
                          fraction_at(arc.geometry, to, arc.length)));
}

void measure(FittedCurve& fitted) { fitted.arc_length.build(fitted.curve, &fitted.curvature); }

Segment make_curve_segment(FittedCurve&& fitted) {
  Segment segment;
  segment.length = fitted.arc_length.length();
  segment.begin = point_from(fitted.curve.derivatives(fitted.curve.u_min()));
  segment.end = point_from(fitted.curve.derivatives(fitted.curve.u_max()));
  segment.geometry = std::move(fitted);
  return segment;
}

}  // namespace twin::path

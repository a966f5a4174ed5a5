#include "path/segment.hpp"

#include <algorithm>
#include <utility>

#include "geometry/nurbs/refine.hpp"

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

PathPoint point_at(const FittedCurve& curve, double s) noexcept {
  return point_from(curve.curve.derivatives(curve.arc_length.u_at(curve.curve, s, s)));
}

FittedCurve part_of(const FittedCurve& curve, double from, double to) {
  const auto u_at = [&](double s) {
    return std::clamp(curve.arc_length.u_at(curve.curve, s, s), curve.curve.u_min(),
                      curve.curve.u_max());
  };
  const double u0 = u_at(from);
  const double u1 = u_at(to);
  const auto degree = static_cast<std::size_t>(curve.curve.degree());
  std::vector<double> knots(degree + 1, u0);
  for (const double knot : curve.curve.knots()) {
    if (knot > u0 && knot < u1) {
      knots.push_back(knot);
    }
  }
  knots.insert(knots.end(), degree + 1, u1);
  FittedCurve part;
  part.curve = geometry::refine(curve.curve, std::move(knots));
  part.is_programmed = curve.is_programmed;
  measure(part);
  return part;
}

void measure(FittedCurve& fitted, geometry::Sampling sampling) {
  fitted.arc_length.build(fitted.curve, &fitted.curvature, sampling);
}

Segment make_curve_segment(FittedCurve&& fitted) {
  Segment segment;
  segment.length = fitted.arc_length.length();
  segment.begin = point_from(fitted.curve.derivatives(fitted.curve.u_min()));
  segment.end = point_from(fitted.curve.derivatives(fitted.curve.u_max()));
  segment.geometry = std::move(fitted);
  return segment;
}

}  // namespace twin::path

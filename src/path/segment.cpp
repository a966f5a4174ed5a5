#include "path/segment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace twin::path {
namespace {

// Gauss-Legendre with four points, the half of them at positive places.
constexpr std::array<double, 2> kNodes{0.33998104358485626, 0.86113631159405258};
constexpr std::array<double, 2> kWeights{0.65214515486254614, 0.34785484513745386};

/// ds/df of an arc at fraction f.
double stretch(const gcode::ArcGeometry& g, double f) noexcept {
  const double along = (g.radius + f * g.radius_change) * g.sweep;
  return std::sqrt(along * along + g.radius_change * g.radius_change + g.rise * g.rise);
}

/// Arc length from fraction 0 to f, by Gauss-Legendre with four points: the radius changes by a
/// rounding only.
double length_to(const gcode::ArcGeometry& g, double f) noexcept {
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    sum += kWeights[i] *
           (stretch(g, 0.5 * f * (1.0 - kNodes[i])) + stretch(g, 0.5 * f * (1.0 + kNodes[i])));
  }
  return 0.5 * f * sum;
}

}  // namespace

double fraction_at(const Arc& arc, double s) noexcept {
  double f = s / arc.length;
  if (arc.geometry.radius_change != 0.0) {
    for (int i = 0; i < 3; ++i) {
      f += (s - length_to(arc.geometry, f)) / stretch(arc.geometry, f);
    }
  }
  return std::clamp(f, 0.0, 1.0);
}

PathPoint point_at(const Line& line, double s) noexcept {
  return {line.start + s * line.direction, line.direction, Vec3::Zero()};
}

PathPoint point_at(const Arc& arc, double s) noexcept {
  const gcode::ArcGeometry& g = arc.geometry;
  const double f = fraction_at(arc, s);
  const double angle = f * g.sweep;
  const double r = g.radius + f * g.radius_change;
  const Vec3 out = std::cos(angle) * g.e1 + std::sin(angle) * g.e2;
  const Vec3 on = std::cos(angle) * g.e2 - std::sin(angle) * g.e1;
  const Vec3 axis = g.e1.cross(g.e2);
  const double pace = stretch(g, f);
  const Vec3 first = r * g.sweep * on + g.radius_change * out + g.rise * axis;
  const Vec3 second = -r * g.sweep * g.sweep * out + 2.0 * g.radius_change * g.sweep * on;
  const Vec3 tangent = first / pace;
  return {g.centre + r * out + f * g.rise * axis, tangent,
          (second - second.dot(tangent) * tangent) / (pace * pace)};
}

PathPoint point_from(const geometry::Derivatives& d) noexcept {
  const double pace = d.first.norm();
  const Vec3 tangent = pace > 0.0 ? Vec3(d.first / pace) : Vec3::UnitX();
  const Vec3 curvature = pace > 0.0
                             ? Vec3((d.second - d.second.dot(tangent) * tangent) / (pace * pace))
                             : Vec3::Zero();
  return {d.position, tangent, curvature};
}

Arc make_arc(const gcode::ArcGeometry& geometry) noexcept {
  return {geometry, length_to(geometry, 1.0)};
}

}  // namespace twin::path

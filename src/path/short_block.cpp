#include "path/short_block.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::path {

double critical_corner_angle(double feedrate, double corner_error, const PlanningModel& model) {
  const double argument = model.kp / (1.0 - model.kf) * corner_error / feedrate;
  return argument >= 1.0 ? 0.0 : 2.0 * std::acos(argument);
}

double corner_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  const Vec3 a = p0 - p1;
  const Vec3 b = p2 - p1;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double bi_chord_error(const Vec3& p0, const Vec3& p1, const Vec3& p2) {
  const Vec3 a = p1 - p0;
  const Vec3 b = p2 - p1;
  if (a.dot(b) <= 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  const double length_a = a.norm();
  const double length_b = b.norm();
  const double twice_area = a.cross(b).norm();
  if (twice_area == 0.0) {
    return 0.0;
  }
  const double radius = length_a * length_b * (p2 - p0).norm() / (2.0 * twice_area);
  const double half = 0.5 * std::max(length_a, length_b);
  return half * half / (radius + std::sqrt(std::max(radius * radius - half * half, 0.0)));
}

bool is_bi_chord_within(const Vec3& p0, const Vec3& p1, const Vec3& p2, double tolerance) {
  const Vec3 a = p1 - p0;
  const Vec3 b = p2 - p1;
  // With R = |a| |b| |c| / (2 |a x b|) and h = max(|a|, |b|) / 2 the error is at most h^2 / R.
  const double square_a = a.squaredNorm();
  const double square_b = b.squaredNorm();
  const double square_h = 0.25 * std::max(square_a, square_b);
  const double most = 0.999 * tolerance;
  if (a.dot(b) > 0.0 && 4.0 * square_h * square_h * a.cross(b).squaredNorm() <=
                            most * most * square_a * square_b * (p2 - p0).squaredNorm()) {
    return true;
  }
  return bi_chord_error(p0, p1, p2) <= tolerance;
}

}  // namespace twin::path

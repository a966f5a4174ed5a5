#include "pictures/plot/normal_error.hpp"

#include <cmath>

namespace twin::pictures {

Vec2 normal_error(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& measured) {
  constexpr double still = 1e-12;    // [mm]
  constexpr double straight = 1e-7;  // [1/mm] a radius of 10 km
  const Vec2 ab = b - a;
  const Vec2 bc = c - b;
  const Vec2 chord = c - a;
  if (chord.norm() < still) {
    return Vec2::Zero();
  }
  Vec2 tangent = chord.normalized();
  double kappa = 0.0;  // signed curvature [1/mm], positive to the left
  if (ab.norm() > still && bc.norm() > still) {
    // The tangent makes with a chord the angle whose sine is chord / (2 r).
    tangent = (ab / ab.squaredNorm() + bc / bc.squaredNorm()).normalized();
    kappa = 2.0 * (ab.x() * bc.y() - ab.y() * bc.x()) / (ab.norm() * bc.norm() * chord.norm());
  }
  const Vec2 normal(-tangent.y(), tangent.x());
  const Vec2 error = measured - b;
  if (std::fabs(kappa) < straight || std::fabs(kappa) * error.norm() > 0.5) {
    return error.dot(normal) * normal;
  }
  const Vec2 from_centre = error - normal / kappa;
  return from_centre * (1.0 - 1.0 / (std::fabs(kappa) * from_centre.norm()));
}

}  // namespace twin::pictures

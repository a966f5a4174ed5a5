#include "feedrate/certified/by_arc_length.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

ByArcLength by_arc_length(const geometry::Derivatives& at, const Vec3& third) {
  const double square = std::max(at.first.squaredNorm(), 1e-300);
  const double u1 = 1.0 / std::sqrt(square);
  const double mixed = at.first.dot(at.second);
  const double u2 = -mixed / (square * square);
  const double u3 = (4.0 * mixed * mixed / square - at.second.squaredNorm() - at.first.dot(third)) /
                    (square * square) * u1;
  return {u1 * at.first, (u1 * u1) * at.second + u2 * at.first,
          (u1 * u1 * u1) * third + (3.0 * u1 * u2) * at.second + u3 * at.first};
}

Vec3 arc_twist(const geometry::Arc& arc, const path::PathPoint& at) {
  const Vec3 across = arc.e1.dot(at.tangent) * arc.e1 + arc.e2.dot(at.tangent) * arc.e2;
  const double square = across.squaredNorm();
  if (!(square > 0.0)) {
    return Vec3::Zero();
  }
  return -(at.curvature.squaredNorm() / square) * across;
}

}  // namespace twin::feedrate

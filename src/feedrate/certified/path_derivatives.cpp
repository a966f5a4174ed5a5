#include "feedrate/certified/path_derivatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace twin::feedrate {
namespace {

/// Bound of the third derivative, over what three samples of it give. It covers what a parabola
/// through them does not see, and costs 1.6 % of the feedrate where the jerk of an axis binds;
/// twice the margin would cost 1.6 % more.
constexpr double kTwistMargin = 1.05;

}  // namespace

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

/// On a helix of radius r and rise 2 pi p, with c^2 = r^2 + p^2, it is the part of C'
/// across the axis, of length r / c, times -1 / c^2; and |C''| = r / c^2. So with that part T
///   C''' = -(|C''| / |T|)^2 T.
Vec3 arc_twist(const geometry::Arc& arc, const path::PathPoint& at) {
  const Vec3 across = arc.e1.dot(at.tangent) * arc.e1 + arc.e2.dot(at.tangent) * arc.e2;
  const double square = across.squaredNorm();
  if (!(square > 0.0)) {
    return Vec3::Zero();
  }
  return -(at.curvature.squaredNorm() / square) * across;
}

PathBounds bounds_between(const ByArcLength& a, const ByArcLength& c, const ByArcLength& b,
                          double length) {
  const auto largest = [](const Vec3& x, const Vec3& y, const Vec3& z) -> Vec3 {
    return x.cwiseAbs().cwiseMax(y.cwiseAbs()).cwiseMax(z.cwiseAbs());
  };
  PathBounds bounds;
  const Vec3 bulge = (c.third - 0.5 * (a.third + b.third)).cwiseAbs();
  for (int i = 0; i < 3; ++i) {
    const std::array<double, 3> signs{a.second[i] * a.third[i], c.second[i] * c.third[i],
                                      b.second[i] * b.third[i]};
    const auto [least, most] = std::minmax_element(signs.begin(), signs.end());
    bounds.trend[i] = *least >= 0.0 ? 1.0 : *most <= 0.0 ? -1.0 : 0.0;
  }
  bounds.twist = kTwistMargin * (largest(a.third, c.third, b.third) + bulge);
  bounds.curvature = largest(a.second, c.second, b.second) + 0.25 * length * bounds.twist;
  bounds.tangent = (largest(a.first, c.first, b.first) + 0.25 * length * bounds.curvature)
                       .cwiseMin(Vec3::Ones());
  return bounds;
}

PathBounds vector_bounds_between(const ByArcLength& a, const ByArcLength& c, const ByArcLength& b,
                                 double length) {
  const auto largest = [](const Vec3& x, const Vec3& y, const Vec3& z) {
    return std::sqrt(std::max({x.squaredNorm(), y.squaredNorm(), z.squaredNorm()}));
  };
  PathBounds bounds;
  const double bulge = (c.third - 0.5 * (a.third + b.third)).norm();
  bounds.twist[0] = kTwistMargin * (largest(a.third, c.third, b.third) + bulge);
  bounds.curvature[0] = largest(a.second, c.second, b.second) + 0.25 * length * bounds.twist[0];
  bounds.tangent[0] = 1.0;
  return bounds;
}

}  // namespace twin::feedrate

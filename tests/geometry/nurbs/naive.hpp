#pragma once

#include "geometry/nurbs/curve.hpp"

/// The definitions themselves, evaluated as they stand: slow, and sharing nothing with the code
/// under test.
namespace twin::test {

/// N_{i,p}(u) [WY09, Eqs. 9, 10], 0/0 = 0; the last span that is not empty is taken as closed.
inline double naive_basis(const std::vector<double>& knots, int i, int p, double u) {
  if (p == 0) {
    const bool at_end = u == knots.back() && knots[i + 1] == knots.back();
    return (knots[i] <= u && u < knots[i + 1]) || (at_end && knots[i] < knots[i + 1]) ? 1.0 : 0.0;
  }
  const double left = knots[i + p] - knots[i];
  const double right = knots[i + p + 1] - knots[i + 1];
  return (left > 0 ? (u - knots[i]) / left * naive_basis(knots, i, p - 1, u) : 0.0) +
         (right > 0 ? (knots[i + p + 1] - u) / right * naive_basis(knots, i + 1, p - 1, u) : 0.0);
}

/// C(u) [WY09, Eq. 7].
inline Vec3 naive_position(const geometry::Curve& c, double u) {
  Vec3 sum = Vec3::Zero();
  double w = 0.0;
  for (int i = 0; i < static_cast<int>(c.control_points().size()); ++i) {
    const double share =
        naive_basis(c.knots(), i, c.degree(), u) * (c.is_rational() ? c.weights()[i] : 1.0);
    sum += share * c.control_points()[i];
    w += share;
  }
  return sum / w;
}

}  // namespace twin::test

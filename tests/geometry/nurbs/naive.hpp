#pragma once

#include <cmath>

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

/// The solution x of a x = b by elimination with the largest pivot of each column.
inline Eigen::MatrixXd solve_with_pivots(Eigen::MatrixXd a, Eigen::MatrixXd b) {
  const Eigen::Index n = a.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index r = k + 1; r < n; ++r) {
      pivot = std::abs(a(r, k)) > std::abs(a(pivot, k)) ? r : pivot;
    }
    a.row(k).swap(a.row(pivot));
    b.row(k).swap(b.row(pivot));
    for (Eigen::Index r = k + 1; r < n; ++r) {
      const double share = a(r, k) / a(k, k);
      a.row(r) -= share * a.row(k);
      b.row(r) -= share * b.row(k);
    }
  }
  for (Eigen::Index k = n - 1; k >= 0; --k) {
    for (Eigen::Index i = k + 1; i < n; ++i) {
      b.row(k) -= a(k, i) * b.row(i);
    }
    b.row(k) /= a(k, k);
  }
  return b;
}

}  // namespace twin::test

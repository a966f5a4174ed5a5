#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace twin::programs {

/// B-spline curve C(t) = sum_i N_{i,p}(t) P_i of degree p over a clamped knot vector.
///
/// Evaluated by de Boor's triangle; the derivative is the B-spline of degree p - 1 with the points
///   Q_i = p (P_{i+1} - P_i) / (t_{i+p+1} - t_{i+1}).
/// Dim is 2 for an outline in the plane [mm], 3 for homogeneous coordinates (w x, w y, w) of a
/// rational curve.
template <int Dim>
struct BSpline {
  using Point = Eigen::Matrix<double, Dim, 1>;

  static constexpr std::size_t kMaxDegree = 5;

  int degree = 0;             ///< p
  std::vector<double> knots;  ///< t_0 .. t_{n+p+1}, clamped
  std::vector<Point> points;  ///< P_0 .. P_n [mm]

  [[nodiscard]] double first() const { return knots.front(); }
  [[nodiscard]] double last() const { return knots.back(); }

  /// Index k of the knot span t_k <= t < t_{k+1}; the last span is closed.
  [[nodiscard]] std::size_t span(double t) const {
    const auto low = knots.begin() + degree;
    const auto high = knots.end() - degree - 1;
    const auto above = std::upper_bound(low, high, t);
    return static_cast<std::size_t>(std::max(above, low + 1) - knots.begin()) - 1 -
           (above == high && t >= *high ? 0U : 0U);
  }

  /// C(t) [mm]; outside the knots the end spans are continued.
  [[nodiscard]] Point at(double t) const {
    const auto p = static_cast<std::size_t>(degree);
    const std::size_t k = span(t);
    std::array<Point, kMaxDegree + 1> d;
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(k - p), p + 1, d.begin());
    for (std::size_t r = 1; r <= p; ++r) {
      for (std::size_t j = p; j >= r; --j) {
        const double low = knots[j + k - p];
        const double high = knots[j + 1 + k - r];
        const double a = (t - low) / (high - low);
        d[j] = (1.0 - a) * d[j - 1] + a * d[j];
      }
    }
    return d[p];
  }

  /// C'(t) as a curve.
  [[nodiscard]] BSpline derivative() const {
    BSpline out;
    out.degree = degree - 1;
    out.knots.assign(knots.begin() + 1, knots.end() - 1);
    const auto p = static_cast<std::size_t>(degree);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      out.points.push_back(degree * (points[i + 1] - points[i]) /
                           (knots[i + p + 1] - knots[i + 1]));
    }
    return out;
  }
};

}  // namespace twin::programs

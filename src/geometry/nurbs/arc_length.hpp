#pragma once

#include <array>
#include <vector>

#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/span_cubic.hpp"

namespace twin::geometry {

/// Curvature of a curve at one place.
struct CurvatureSample {
  double u;          ///< parameter
  double s;          ///< arc length from the beginning of the curve [mm]
  double curvature;  ///< [1/mm]
};

/// Arc length s(u) = integral of |C'| from u_min to u, and its inverse u(s), of one curve.
///
/// The domain is divided at the knots, and further until five-point Gauss-Legendre quadrature of
/// the speed |C'| is good to 1e-9 mm on each interval. A table holds s at the beginning of each.
///
/// On a cubic that is not rational, |C'|^2 is a polynomial q of degree 4 in x = -1..1 across the
/// interval; it is stored, and evaluating the speed costs a Horner scheme and a root. There the
/// division is certain: where sum_{k>=1} |q_k| R^k <= q_0 / 2 with R = 8, sqrt(q) is analytic in
/// the disc |x| <= R and at most sqrt(3/2 q_0) there; the disc holds the Bernstein ellipse of r = R
/// + sqrt(R^2 - 1), and n = 5 points err by no more than
///   64/15 sqrt(3/2 q_0) r^(-2n) / (1 - r^-2),                                                  (1)
/// 2.5e-12 of the interval's length. Any other curve is evaluated as it is, and an interval is
/// accepted where its two halves agree with the whole to 1e-10 mm or 1e-13 of the coordinates; the
/// number of divisions is bounded.
///
/// The object holds nothing of the curve's own; the calls take the curve that it was built for.
class ArcLength {
 public:
  /// Builds the table.
  ///
  /// @param samples  if given, gets the curvature at four equal steps of u on each interval and at
  /// the very end, in
  ///                 ascending order. C'' of a cubic is greatest at a knot, and every knot is a
  ///                 sample. Their s is good to 1e-5 of the interval's length at worst, at the
  ///                 knots to that of the table.
  /// @note Allocates only while the table grows beyond what it held before.
  void build(const Curve& curve, std::vector<CurvatureSample>* samples = nullptr);

  /// Length of the whole curve [mm].
  double length() const noexcept { return length_; }

  /// Arc length at u [mm]; u is clamped to the domain. @note Real-time safe.
  double s_at(const Curve& curve, double u) const noexcept;

  /// Parameter at arc length s [mm], by Newton's method within the interval that holds s; the place
  /// is met to 1e-10 mm of arc length. s is clamped to 0..length(), NaN to 0.
  ///
  /// @param u_guess  near the result if known; any value is allowed
  /// @note Real-time safe.
  double u_at(const Curve& curve, double s, double u_guess) const noexcept;

 private:
  struct Interval {
    double begin;  // u
    double half;   // half the width in u
    double s;      // arc length at the beginning [mm]
    std::array<double, 5>
        q;  // |C'|^2 = sum q_k x^k; unused where the curve is not a cubic polynomial
  };
  struct Builder;

  double speed(const Curve& curve, const Interval& interval, double x) const noexcept;
  double partial(const Curve& curve, const Interval& interval, double x) const noexcept;

  std::vector<Interval> intervals_;
  double length_ = 0.0;
  bool is_cubic_ = false;
};

}  // namespace twin::geometry

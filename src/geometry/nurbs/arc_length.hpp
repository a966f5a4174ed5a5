#pragma once

#include <array>
#include <cstdint>
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

/// Where ArcLength::build() samples the curvature.
enum class Sampling : std::uint8_t {
  kEven,    ///< at four equal steps of u on each interval
  kSparse,  ///< few on short intervals on which it falls or rises, closer where it is largest
};

/// Arc length s(u) = integral of |C'| from u_min to u, and its inverse u(s), of one curve.
///
/// The domain is divided at the knots, and further until quadrature of the speed |C'| by the
/// five-point Gauss-Legendre rule is good to 1e-9 mm on each interval. A table holds s at the
/// beginning of each interval.
///
/// On a cubic that is not rational, |C'|^2 is a polynomial q of degree 4 in x = -1..1 across the
/// interval. The table holds q, so that the speed costs a Horner scheme and a root. Whether the
/// quadrature is good enough is then decided with certainty: where
///   sum_{k>=1} |q_k| R^k <= q_0 / 2,   R = 8,                                                  (1)
/// sqrt(q) is analytic in the disc |x| <= R, and at most sqrt(3/2 q_0) there. The disc holds the
/// Bernstein ellipse of parameter r = R + sqrt(R^2 - 1), so the error of n = 5 points is at most
///   64/15 sqrt(3/2 q_0) r^(-2n) / (1 - r^-2),                                                  (2)
/// which is 2.5e-12 of the length of the interval.
///
/// With sparse samples, R = 4 and a sum of up to 0.95 q_0 are enough for an interval that is shorter than
/// 0.03 mm: with sqrt(1.95 q_0) in (2) it is 4e-9 of the length, which is 1e-10 mm. Such an interval is taken only where curvature rises or
/// falls over it: the parabola through the curvature at its ends and in its middle has no peak
/// within it. Then the larger curvature of two neighbouring samples bounds that between them.
///
/// For any other curve the speed is evaluated from the curve itself. An interval is accepted where
/// the sum of its two halves agrees with the whole to 1e-10 mm or 1e-13 of the coordinates. The
/// number of divisions is bounded.
///
/// The table holds no copy of the curve: each call takes the curve that it was built for.
class ArcLength {
 public:
  /// Builds the table.
  ///
  /// @param samples   if given, receives the curvature at four equal steps of u on each interval and
  ///                  at the very end, in ascending order. C'' of a cubic is greatest at a knot, and
  ///                  every knot is a sample. The s of a sample is good to 1e-5 of the length of the
  ///                  interval, and at a knot as good as that of the table.
  /// @param sampling  says whether fewer samples are enough
  /// @note Allocates only while the table grows beyond what it held before.
  void build(const Curve& curve, std::vector<CurvatureSample>* samples = nullptr,
             Sampling sampling = Sampling::kEven);

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
    // |C'|^2 = sum q_k x^k; unused where the curve is not a cubic polynomial
    std::array<double, 5> q;
  };
  struct Builder;

  double speed(const Curve& curve, const Interval& interval, double x) const noexcept;
  double partial(const Curve& curve, const Interval& interval, double x) const noexcept;

  std::vector<Interval> intervals_;
  double length_ = 0.0;
  bool is_cubic_ = false;
};

}  // namespace twin::geometry

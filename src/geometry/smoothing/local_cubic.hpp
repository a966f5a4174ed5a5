#pragma once

#include <array>
#include <span>

#include "core/vec.hpp"
#include "geometry/smoothing/path_moments.hpp"

namespace twin::geometry {

/// The cubic that fits the smooth path A(s) of a polygon best over an interval of arc length: the
/// mean square of their distance is smallest.
///
/// With x = -1..1 across the interval and Legendre's polynomials L_k,
///   p(x) = sum_k c_k L_k(x),   c_k = (2 k + 1) / 2 integral of A(s(x)) L_k(x) dx,   k = 0..3.  (1)
/// The integrals come from the moments of A(s) over parts of the interval (PathMoments). A part of half
/// width d_i around x = a_i with the moments m_k about the origin O_i adds to those about O
///   d_i sum_j binomial(k, j) a_i^(k-j) d_i^j (m_j + (O_i - O) e_j),   e = (2, 0, 2/3, 0).        (2)
/// Neighbouring intervals, whose cubics are wanted one after the other, share such parts.
///
/// @note Real-time safe.
class LocalCubic {
 public:
  /// @param parts  of the interval, one after the other, one at least
  explicit LocalCubic(std::span<const PathMoments> parts) noexcept;

  /// Mean square of the distance between cubic and path over the interval [mm^2].
  double mean_square() const noexcept { return mean_square_; }

  /// Blossom (polar form) of the cubic at three arguments: the begin of the interval, a place
  /// within it, and its end. If these are successive knots of a B-spline that equals the cubic
  /// there, the blossom is one of its control points. With x of the place in the middle it is
  ///   c_0 + (x / 3) c_1 - c_2 - 3 x c_3                                                        (3)
  /// since the blossoms of 1, x, x^2, x^3 at (-1, x, 1) are 1, x/3, -1/3, -x [mm].
  /// @param middle  arc length of the place in the middle [mm]
  Vec3 blossom(double middle) const noexcept;

  /// Approximate angle by which the cubic turns over the interval: |C''| in the middle times the
  /// length of the interval, |C''| = 3 |c_2| / half width^2 [rad].
  double turn() const noexcept { return 6.0 * moment_[2].norm() / half_; }

  /// Number of blocks in the interval, whole or in part.
  int blocks() const noexcept { return blocks_; }

 private:
  void add(const PathMoments& part) noexcept;
  void finish() noexcept;

  double centre_;
  double half_;
  Vec3 origin_;
  std::array<Vec3, 4> moment_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  double square_ = 0.0;
  double mean_square_ = 0.0;
  int blocks_ = 0;
};

/// The kernel K by which LocalCubic::blossom() is a single integral over the fitted function f:
///   blossom = integral of f(s) K(s) ds / half width,
///   K = 1/2 + (x_m / 2) x - (5/2) L_2(x) - (21/2) x_m L_3(x),
/// where x_m is the x of the place in the middle. It follows from Eqs. 1 and 3 of LocalCubic.
class BlossomKernel {
 public:
  BlossomKernel(double begin, double middle, double end) noexcept
      : centre_(0.5 * (begin + end)),
        inverse_(2.0 / (end - begin)),
        middle_((middle - centre_) * inverse_) {}

  /// K divided by the half width, at arc length s [1/mm].
  double at(double s) const noexcept {
    const double x = (s - centre_) * inverse_;
    const double l2 = 1.5 * x * x - 0.5;
    const double l3 = x * (2.5 * x * x - 1.5);
    return inverse_ * (0.5 + 0.5 * middle_ * x - 2.5 * l2 - 10.5 * middle_ * l3);
  }

 private:
  double centre_;
  double inverse_;  // of the half width
  double middle_;
};

}  // namespace twin::geometry

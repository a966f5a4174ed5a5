#pragma once

#include "core/vec.hpp"

namespace twin::geometry {

/// Cross product a x b; Eigen's own would pull in its geometry module.
inline Vec3 cross(const Vec3& a, const Vec3& b) noexcept {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

/// A curve at one parameter u, with its derivatives with respect to u.
struct Derivatives {
  Vec3 position;  ///< C(u) [mm]
  Vec3 first;     ///< C'(u) [mm per unit of u]
  Vec3 second;    ///< C''(u) [mm per unit of u squared]
};

/// Curvature |C' x C''| / |C'|^3 [1/mm]; 0 where C' vanishes.
/// @note Real-time safe.
double curvature(const Derivatives& at) noexcept;

/// Where one non-empty span of a curve lies in memory.
struct SpanView {
  const double* knot;    ///< address of u_s; p knots before it and p+1 after it belong to the curve
  const Vec3* point;     ///< address of control point P_{s-p}; p+1 of them are used [mm]
  const double* weight;  ///< address of weight w_{s-p}, or null: all weights are 1
};

/// C(u), C'(u) and C''(u) on one span, in one pass of the Cox-de Boor recursion.
///
/// With A(u) = sum N_{i,p} w_i P_i and w(u) = sum N_{i,p} w_i, C = A / w [WY09, Eq. 22] and
///   C'  = (A' - w' C) / w                                         [WY09, Eq. 25]
///   C'' = (A'' - 2 w' C' - w'' C) / w                             [WY09, Eq. 26].
/// Derivatives of A and w are B-splines of lower degree [WY09, Eqs. 27, 28]:
///   B^(m)(u) = sum_i N_{i,p-m}(u) P_i^(m),
///   P_i^(m) = (p-m+1) / (u_{i+p+1} - u_{i+m}) (P_{i+1}^(m-1) - P_i^(m-1)).
///
/// @param degree  degree p, 1..kMaxDegree
/// @param u       parameter in the closed span; outside it the span's polynomials are extrapolated
/// @note Real-time safe.
Derivatives evaluate_derivatives(int degree, const SpanView& span, double u) noexcept;

/// C(u) alone, by the same recursion.
/// @note Real-time safe.
Vec3 evaluate_position(int degree, const SpanView& span, double u) noexcept;

}  // namespace twin::geometry

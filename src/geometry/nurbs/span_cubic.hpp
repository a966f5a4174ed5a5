#pragma once

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// One span of a cubic B-spline as a polynomial about the beginning of the span,
///   C(u) = c0 + c1 t + c2 t^2 + c3 t^3,   t = u - begin,   begin <= u <= end.
struct SpanCubic {
  double begin, end;  ///< [u_s, u_{s+1}]
  Vec3 c0;            ///< C(begin) [mm]
  Vec3 c1;            ///< C'(begin)
  Vec3 c2;            ///< C''(begin) / 2
  Vec3 c3;            ///< C''' / 6, constant on the span

  Vec3 position(double u) const noexcept {
    const double t = u - begin;
    return c0 + t * (c1 + t * (c2 + t * c3));
  }
  Vec3 second(double u) const noexcept { return 2.0 * c2 + (6.0 * (u - begin)) * c3; }
};

/// Polynomial of one non-empty span, by [WY09, Eqs. 27, 28] with m = 0..3 at the beginning of the
/// span.
///
/// @param curve  of degree 3 and not rational
/// @note Real-time safe.
SpanCubic span_cubic(const Curve& curve, int span) noexcept;

/// The same of a span of degree 3 without weights.
/// @note Real-time safe.
SpanCubic span_cubic(const SpanView& view) noexcept;

}  // namespace twin::geometry

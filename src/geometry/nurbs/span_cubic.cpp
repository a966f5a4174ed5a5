#include "geometry/nurbs/span_cubic.hpp"

#include <cassert>

namespace twin::geometry {

SpanCubic span_cubic(const Curve& curve, int span) noexcept {
  assert(curve.degree() == 3 && !curve.is_rational());
  return span_cubic(curve.span_view(span));
}

SpanCubic span_cubic(const SpanView& view) noexcept {
  const double* u = view.knot;  // u[0] is u_s
  const Vec3* p = view.point;   // P_{s-3} .. P_s
  const double w3 = 1.0 / (u[1] - u[0]);
  const double w2 = 1.0 / (u[1] - u[-1]);

  // Control points of C', C'' and C''' on this span.
  const double inv_a = 1.0 / (u[1] - u[-2]);
  const Vec3 a = (p[1] - p[0]) * (3.0 * inv_a);
  const Vec3 b = (p[2] - p[1]) * (3.0 / (u[2] - u[-1]));
  const Vec3 c = (p[3] - p[2]) * (3.0 / (u[3] - u[0]));
  const Vec3 ab = (b - a) * (2.0 * w2);
  const Vec3 bc = (c - b) * (2.0 / (u[2] - u[0]));
  const Vec3 abc = (bc - ab) * w3;

  // At u_s only the first basis function of degree 1 and the first two of degree 2 are not zero; de
  // Boor's triangle for C closes after two steps.
  const double before = u[0] - u[-1];
  const Vec3 first = a + (0.5 * before) * ab;
  const Vec3 left = p[0] + ((u[0] - u[-2]) / 3.0) * a;
  const Vec3 right = p[1] + (before / 3.0) * b;
  const Vec3 position = left + (before * w2) * (right - left);
  return {u[0], u[1], position, first, 0.5 * ab, abc / 6.0};
}

}  // namespace twin::geometry

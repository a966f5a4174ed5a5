#include "geometry/nurbs/derivatives.hpp"

#include <cmath>

#include "geometry/nurbs/basis.hpp"

namespace twin::geometry {
namespace {

using Vec4 = Eigen::Vector4d;

/// Coordinates that a B-spline can have: the points themselves, or (w P, w) of a rational curve (4
/// x 1).
template <class Point>
Point coordinates(const SpanView& span, int j) noexcept {
  if constexpr (Point::RowsAtCompileTime == 3) {
    return span.point[j];
  } else {
    const double w = span.weight[j];
    const Vec3& p = span.point[j];
    return {w * p.x(), w * p.y(), w * p.z(), w};
  }
}

template <class Point>
struct SplineDerivatives {
  Point value, first, second;
};

/// B, B', B'' of a B-spline of degree P [WY09, Eqs. 27, 28].
template <int P, class Point>
SplineDerivatives<Point> spline_derivatives(const SpanView& span, double u) noexcept {
  const Basis<P> basis = evaluate_basis<P>(span.knot, u);
  std::array<Point, P + 1> q;
  for (int j = 0; j <= P; ++j) {
    q[j] = coordinates<Point>(span, j);
  }
  SplineDerivatives<Point> b{q[0] * basis.n[0], Point::Zero(), Point::Zero()};
  for (int j = 1; j <= P; ++j) {
    b.value += q[j] * basis.n[j];
  }
  for (int j = 0; j < P; ++j) {  // q becomes P^(1)
    q[j] = (q[j + 1] - q[j]) * (P * basis.inv1[j]);
    b.first += q[j] * basis.n1[j];
  }
  for (int j = 0; j + 1 < P; ++j) {  // q becomes P^(2)
    q[j] = (q[j + 1] - q[j]) * ((P - 1) * basis.inv2[j]);
    b.second += q[j] * basis.n2[j];
  }
  return b;
}

template <int P>
Derivatives derivatives_of_degree(const SpanView& span, double u) noexcept {
  if (span.weight == nullptr) {
    const auto b = spline_derivatives<P, Vec3>(span, u);
    return {b.value, b.first, b.second};
  }
  const SplineDerivatives<Vec4> a = spline_derivatives<P, Vec4>(span, u);
  const double inverse_w = 1.0 / a.value.w();
  Derivatives c;
  c.position = a.value.head<3>() * inverse_w;
  c.first = (a.first.head<3>() - a.first.w() * c.position) * inverse_w;
  c.second =
      (a.second.head<3>() - 2.0 * a.first.w() * c.first - a.second.w() * c.position) * inverse_w;
  return c;
}

template <int P>
Vec3 position_of_degree(const SpanView& span, double u) noexcept {
  const Basis<P> basis = evaluate_basis<P>(span.knot, u);
  Vec3 sum = Vec3::Zero();
  double w = 0.0;
  for (int j = 0; j <= P; ++j) {
    const double share = span.weight == nullptr ? basis.n[j] : basis.n[j] * span.weight[j];
    sum += share * span.point[j];
    w += share;
  }
  return span.weight == nullptr ? sum : Vec3(sum / w);
}

}  // namespace

double curvature(const Derivatives& at) noexcept {
  const double speed_squared = at.first.squaredNorm();
  const double cubed = speed_squared * std::sqrt(speed_squared);
  return cubed > 0.0 ? cross(at.first, at.second).norm() / cubed : 0.0;
}

Derivatives evaluate_derivatives(int degree, const SpanView& span, double u) noexcept {
  switch (degree) {
    case 1:
      return derivatives_of_degree<1>(span, u);
    case 2:
      return derivatives_of_degree<2>(span, u);
    case 3:
      return derivatives_of_degree<3>(span, u);
    case 4:
      return derivatives_of_degree<4>(span, u);
    default:
      return derivatives_of_degree<5>(span, u);
  }
}

Vec3 evaluate_position(int degree, const SpanView& span, double u) noexcept {
  switch (degree) {
    case 1:
      return position_of_degree<1>(span, u);
    case 2:
      return position_of_degree<2>(span, u);
    case 3:
      return position_of_degree<3>(span, u);
    case 4:
      return position_of_degree<4>(span, u);
    default:
      return position_of_degree<5>(span, u);
  }
}

}  // namespace twin::geometry

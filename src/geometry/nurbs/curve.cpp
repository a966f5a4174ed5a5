#include "geometry/nurbs/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace twin::geometry {
namespace {

Expected<void> check_weights(const std::vector<double>& weights, std::size_t control_points) {
  if (!weights.empty() && weights.size() != control_points) {
    return fail(ErrorCode::kProgram, fmt::format("curve: {} weights for {} control points",
                                                 weights.size(), control_points));
  }
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] > 0.0) || !std::isfinite(weights[i])) {
      return fail(ErrorCode::kProgram,
                  fmt::format("curve: weight {} is {}, must be finite and above 0", i, weights[i]));
    }
  }
  return {};
}

Expected<void> check_points(const std::vector<Vec3>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      return fail(ErrorCode::kProgram,
                  fmt::format("curve: control point {} has a coordinate that is not finite", i));
    }
  }
  return {};
}

/// The 9 corners and tangent points of the square around the unit circle, counter-clockwise from
/// (1, 0).
constexpr std::array<std::array<double, 2>, 9> kSquare = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};

/// Control point i of the circle of degree 2 on the unit circle, as (w x, w y, w).
Vec3 homogeneous(std::size_t i) {
  const double w = i % 2 == 0 ? 1.0 : 0.5 * std::numbers::sqrt2;
  return {w * kSquare[i][0], w * kSquare[i][1], w};
}

std::vector<Vec3> control_points(int degree) {
  std::vector<Vec3> points;
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const Vec3 a = homogeneous(2 * quarter);
    const Vec3 b = homogeneous(2 * quarter + 1);
    const Vec3 c = homogeneous(2 * quarter + 2);
    points.push_back(a);
    if (degree == 2) {
      points.push_back(b);
    } else {
      points.emplace_back((a + 2.0 * b) / 3.0);
      points.emplace_back((2.0 * b + c) / 3.0);
    }
  }
  points.push_back(homogeneous(8));
  return points;
}

}  // namespace

Expected<Curve> Curve::create(int degree, std::vector<double> knots,
                              std::vector<Vec3> control_points, std::vector<double> weights) {
  TWIN_CHECK(check_knot_vector(degree, knots, control_points.size()));
  TWIN_CHECK(check_points(control_points));
  TWIN_CHECK(check_weights(weights, control_points.size()));
  if (std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; })) {
    weights.clear();
  }
  Curve curve;
  curve.degree_ = degree;
  curve.knots_ = std::move(knots);
  curve.control_points_ = std::move(control_points);
  curve.weights_ = std::move(weights);
  return curve;
}

double Curve::clamped(double u) const noexcept {
  return u > u_min() ? std::min(u, u_max()) : u_min();  // NaN compares false
}

Vec3 Curve::position(double u, int span_hint) const noexcept {
  const double inside = clamped(u);
  return evaluate_position(degree_, span_view(find_span(inside, span_hint)), inside);
}

Derivatives Curve::derivatives(double u, int span_hint) const noexcept {
  const double inside = clamped(u);
  return evaluate_derivatives(degree_, span_view(find_span(inside, span_hint)), inside);
}

Expected<Curve> full_circle(const Vec3& centre, double radius, int degree) {
  if (!(radius > 0.0) || !std::isfinite(radius)) {
    return fail(ErrorCode::kProgram, fmt::format("circle: radius {} mm, must be above 0", radius));
  }
  if (degree != 2 && degree != 3) {
    return fail(ErrorCode::kProgram, fmt::format("circle: degree {}, must be 2 or 3", degree));
  }
  std::vector<Vec3> points;
  std::vector<double> weights;
  for (const Vec3& h : control_points(degree)) {
    points.emplace_back(centre + Vec3(radius * h.x() / h.z(), radius * h.y() / h.z(), 0.0));
    weights.push_back(h.z());
  }
  std::vector<double> knots = {0.0};
  for (int quarter = 0; quarter <= 4; ++quarter) {
    knots.insert(knots.end(), static_cast<std::size_t>(degree), 0.25 * quarter);
  }
  knots.push_back(1.0);
  return Curve::create(degree, std::move(knots), std::move(points), std::move(weights));
}

}  // namespace twin::geometry

#include "geometry/nurbs/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

}  // namespace twin::geometry

#include "geometry/nurbs/bezier_fit.hpp"

#include <cmath>
#include <utility>

namespace twin::geometry {
namespace {

constexpr int kBezierDegree = 3;

/// Tangent at the far end of a chord's circle from the tangent at its near end: mirrored.
Vec3 mirrored(const Vec3& chord, const Vec3& tangent) {
  const Vec3 direction = chord.normalized();
  return 2.0 * direction.dot(tangent) * direction - tangent;
}

}  // namespace

EndCondition circle_condition(const Vec3& before, const Vec3& at, const Vec3& after) {
  const Vec3 in = at - before;
  const Vec3 out = after - at;
  const Vec3 tangent = out.norm() * in.normalized() + in.norm() * out.normalized();
  return {true, tangent.normalized(), Vec3::Zero()};
}

FitResult BezierFitter::fit(std::span<const Vec3> points, const EndCondition& begin,
                            const EndCondition& end, Curve& out) {
  const std::size_t n = points.size() - 1;
  if (points.size() < 2 || (n < 2 && !begin.clamped && !end.clamped)) {
    return FitResult::kTooFewPoints;
  }
  parameters_.assign(1, 0.0);
  for (std::size_t i = 1; i <= n; ++i) {
    const double chord = (points[i] - points[i - 1]).norm();
    if (!(chord > 0.0) || !std::isfinite(chord)) {
      return FitResult::kInvalidPoints;
    }
    parameters_.push_back(parameters_.back() + chord);
  }
  tangents_.resize(n + 1);
  for (std::size_t i = 1; i < n; ++i) {
    tangents_[i] = circle_condition(points[i - 1], points[i], points[i + 1]).first;
  }
  if (end.clamped) {
    tangents_[n] = end.first.normalized();
  }
  if (begin.clamped) {
    tangents_[0] = begin.first.normalized();
  } else {
    tangents_[0] = mirrored(points[1] - points[0], tangents_[1]);
  }
  if (!end.clamped) {
    tangents_[n] = mirrored(points[n] - points[n - 1], tangents_[n - 1]);
  }
  std::vector<double> knots(kBezierDegree + 1, 0.0);
  std::vector<Vec3> control{points[0]};
  for (std::size_t i = 1; i <= n; ++i) {
    const double third = (parameters_[i] - parameters_[i - 1]) / 3.0;
    control.push_back(points[i - 1] + third * tangents_[i - 1]);
    control.push_back(points[i] - third * tangents_[i]);
    knots.insert(knots.end(), i < n ? 2 : kBezierDegree + 1, parameters_[i]);
  }
  control.push_back(points[n]);
  auto curve = Curve::create(kBezierDegree, std::move(knots), std::move(control));
  if (!curve) {
    return FitResult::kInvalidPoints;
  }
  out = std::move(*curve);
  return FitResult::kFitted;
}

}  // namespace twin::geometry

#include "studies/circular/polar_path.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace twin::studies::circular {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

}  // namespace

double wrapped(double angle) {
  const double inside = angle - kTurn * std::floor(angle / kTurn);
  return inside < kTurn ? inside : 0.0;
}

PolarPath::PolarPath(std::span<const Vec2> points, const Vec2& centre) {
  assert(!points.empty());
  points_.reserve(points.size());
  for (const Vec2& point : points) {
    const Vec2 arm = point - centre;
    points_.push_back({wrapped(std::atan2(arm.y(), arm.x())), arm.norm()});
  }
  std::ranges::stable_sort(points_, {}, &PolarPoint::angle);
}

double PolarPath::radius_at(double angle) const {
  const double wanted = wrapped(angle);
  const auto after = std::ranges::upper_bound(points_, wanted, {}, &PolarPoint::angle);
  const PolarPoint& right = after == points_.end() ? points_.front() : *after;
  const PolarPoint& left = after == points_.begin() ? points_.back() : *(after - 1);
  const double span = wrapped(right.angle - left.angle);
  const double share = span > 0.0 ? wrapped(wanted - left.angle) / span : 0.0;
  return left.radius + share * (right.radius - left.radius);
}

}  // namespace twin::studies::circular

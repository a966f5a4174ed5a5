#include "metrics/feedrate_fluctuation.hpp"

#include <algorithm>
#include <cmath>

namespace twin::metrics {
namespace {

constexpr double kSlowest = 1.0;  // [mm/s]
constexpr double kCorner = 0.3;   // [rad]

/// Turn from one way to the next [rad].
double turn(const Vec3& a, const Vec3& b) {
  return 2.0 * std::atan2((a.normalized() - b.normalized()).norm(),
                          (a.normalized() + b.normalized()).norm());
}

}  // namespace

void FeedrateFluctuation::add(const Vec3& point, double feedrate) noexcept {
  std::shift_left(points_.begin(), points_.end(), 1);
  std::shift_left(feedrates_.begin(), feedrates_.end(), 1);
  points_.back() = point;
  feedrates_.back() = feedrate;
  count_ = std::min(count_ + 1, 4);
  if (count_ < 4) {
    return;
  }
  const auto [v0, v1, v2, v3] = feedrates_;
  const double commanded = 0.5 * (v1 + v2) - (v3 - v2 - v1 + v0) / 24.0;
  const Vec3 way = points_[2] - points_[1];
  const double before = turn(points_[1] - points_[0], way);
  const double after = turn(way, points_[3] - points_[2]);
  if (commanded < kSlowest || std::max(before, after) > kCorner) {
    return;
  }
  const double bend = 0.5 * (before + after);
  const double travelled = way.norm() * (1.0 + bend * bend / 24.0) / period_;
  shares_.add(std::abs(travelled - commanded) / commanded);
}

}  // namespace twin::metrics

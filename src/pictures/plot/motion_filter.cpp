#include "pictures/plot/motion_filter.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace twin::pictures {
namespace {

constexpr double kStill = 1e-12;    // [mm] below this a step has no direction
constexpr double kCorner = 0.1;     // [rad] a lone turn of this size is a corner
constexpr double kStepTime = 1e-3;  // [s] that h periods should take

/// Curvature vector of the circle through three points [1/mm]; zero where there is no circle.
Vec3 curvature(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  const double lengths = ab.norm() * bc.norm() * (c - a).norm();
  return lengths > kStill * kStill * kStill ? Vec3(2.0 * ab.cross(bc) / lengths) : Vec3::Zero();
}

double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 bc = c - b;
  return std::atan2(ab.cross(bc).norm(), ab.dot(bc));
}

}  // namespace

MotionFilter::MotionFilter(double period)
    : period_(period),
      step_(static_cast<std::size_t>(std::max(1L, std::lround(kStepTime / period)))),
      arcs_(6 * step_ + 1, 0.0) {}

/// Arc length of the period between the two middle ones of the six points.
double MotionFilter::arc_of_middle_period() const {
  const auto& p = points_;
  const double chord = (p[3] - p[2]).norm();
  if (chord < kStill) {
    return chord;
  }
  const double lone = turn(p[1], p[2], p[3]) + turn(p[2], p[3], p[4]) -
                      2.0 * (turn(p[0], p[1], p[2]) + turn(p[3], p[4], p[5]));
  if (lone > kCorner) {
    return std::max(chord, (feedrates_[2] + feedrates_[3]) / 2.0 * period_);
  }
  const Vec3 mean = (71.0 * (curvature(p[1], p[2], p[3]) + curvature(p[2], p[3], p[4])) -
                     11.0 * (curvature(p[0], p[1], p[2]) + curvature(p[3], p[4], p[5]))) /
                    120.0;
  const double half = std::min(mean.norm() * chord, 2.0) / 2.0;
  return half > 1e-9 ? chord * half / std::sin(half) : chord;
}

/// Arc length s of the point that many periods from the one in the middle of the ring.
double MotionFilter::s(std::ptrdiff_t offset) const noexcept {
  const auto size = static_cast<std::ptrdiff_t>(arcs_.size());
  const auto newest = static_cast<std::ptrdiff_t>(count_);
  return arcs_[static_cast<std::size_t>((newest - size / 2 + offset + 4 * size) % size)];
}

std::optional<TangentialMotion> MotionFilter::push(const Vec3& point, double feedrate) {
  if (count_ == 0) {
    points_.fill(point);
    feedrates_.fill(feedrate);
  }
  std::rotate(points_.begin(), points_.begin() + 1, points_.end());
  points_.back() = point;
  std::rotate(feedrates_.begin(), feedrates_.begin() + 1, feedrates_.end());
  feedrates_.back() = feedrate;
  const std::size_t size = arcs_.size();
  const double before = arcs_[count_ % size];
  ++count_;
  arcs_[count_ % size] = before + arc_of_middle_period();
  if (count_ <= delay()) {
    return std::nullopt;
  }
  const auto h = static_cast<std::ptrdiff_t>(step_);
  const double time = static_cast<double>(step_) * period_;
  TangentialMotion motion;
  motion.acceleration = (s(h) - 2.0 * s(0) + s(-h)) / (time * time);
  motion.jerk = (s(3 * h) - 3.0 * s(h) + 3.0 * s(-h) - s(-3 * h)) / (8.0 * time * time * time);
  return motion;
}

}  // namespace twin::pictures

#include "motion/correction/correction_follower.hpp"

#include <algorithm>

namespace twin::motion {
namespace {

/// 0 at 0, 1 at 1, without slope and curvature at both ends.
double smooth_rise(double x) noexcept {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

}  // namespace

double share_at_rest(double time) noexcept {
  return smooth_rise(time / CorrectionFollower::kFadeTime);
}

/// The offset of a period, faded where the correction has been left.
Vec2 CorrectionFollower::at(std::ptrdiff_t period) const noexcept {
  const std::ptrdiff_t place = std::clamp<std::ptrdiff_t>(period, 0, size() - 1);
  const Vec2& full = correction_->offsets[static_cast<std::size_t>(place)];
  if (left_at_ < 0) {
    return full;
  }
  const double since = static_cast<double>(period - left_at_) * period_;
  return (1.0 - smooth_rise(since / kFadeTime)) * full;
}

void CorrectionFollower::update() noexcept {
  const Vec2 before = at(now_ - 1);
  const Vec2 here = at(now_);
  const Vec2 after = at(now_ + 1);
  offset_.position.head<2>() = here;
  offset_.velocity.head<2>() = (after - before) / (2.0 * period_);
  offset_.acceleration.head<2>() = (after - 2.0 * here + before) / (period_ * period_);
}

void CorrectionFollower::rest() noexcept {
  if (correction_ == nullptr || size() == 0) {
    return;
  }
  ++rested_;
  offset_.position.head<2>() =
      share_at_rest(static_cast<double>(rested_) * period_) * correction_->offsets.front();
}

void CorrectionFollower::follow(const Vec3& point) noexcept {
  if (correction_ == nullptr || size() == 0) {
    return;
  }
  ++now_;
  const bool is_known =
      now_ < size() &&
      (correction_->points[static_cast<std::size_t>(now_)] - point).lpNorm<Eigen::Infinity>() <=
          kTolerance;
  if (left_at_ < 0 && !is_known) {
    left_at_ = now_;
  }
  update();
}

void CorrectionFollower::wait() noexcept {
  if (correction_ == nullptr || size() == 0) {
    return;
  }
  if (now_ + 1 >= size() && left_at_ < 0) {
    offset_.velocity.setZero();
    offset_.acceleration.setZero();
    return;  // the path has ended
  }
  ++now_;
  left_at_ = left_at_ < 0 ? now_ : left_at_;
  update();
}

}  // namespace twin::motion

#include "hal/mujoco/speed_feedback.hpp"

#include <algorithm>
#include <cmath>

namespace twin::hal::mujoco {

SpeedFeedback::SpeedFeedback(const DriveParams& drive, double step)
    : step_(step),
      steps_(std::max(static_cast<int>(std::lround(drive.velocity_loop_period / step)), 1)),
      period_(step * steps_),
      filter_share_(drive.speed_filter > 0.0 ? -std::expm1(-period_ / drive.speed_filter) : 1.0),
      delay_(drive.speed_delay / period_) {}

void SpeedFeedback::step(double speed) noexcept {
  if (steps_ == 1) {
    filtered_ += filter_share_ * (speed - filtered_);
    seen_ = delay_.step(filter_share_ == 1.0 ? speed : filtered_);
    return;
  }
  is_sample_ = since_ == 0;
  if (is_sample_) {
    filtered_ += filter_share_ * (turned_ / period_ - filtered_);
    seen_ = delay_.step(filtered_);
    turned_ = 0.0;
  }
  turned_ += speed * step_;
  since_ = since_ + 1 == steps_ ? 0 : since_ + 1;
}

void SpeedFeedback::reset(double speed) noexcept {
  since_ = 0;
  turned_ = speed * period_;
  filtered_ = seen_ = speed;
  delay_.fill(speed);
  is_sample_ = true;
}

}  // namespace twin::hal::mujoco

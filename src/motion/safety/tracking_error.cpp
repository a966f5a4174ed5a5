#include "motion/safety/tracking_error.hpp"

#include <cmath>

namespace twin::motion {

TrackingError::TrackingError(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
    : least_(settings.tracking_error),
      per_feedrate_(settings.tracking_error_per_feedrate),
      filter_time_(settings.tracking_filter_time) {}

std::optional<Finding> TrackingError::check(const AxisView& view) noexcept {
  const double error = std::abs(view.command - view.measured);
  const double limit = least_ + per_feedrate_ * std::abs(view.feedrate);
  if (error <= limit) {
    exceeded_for_ = 0.0;
    return std::nullopt;
  }
  exceeded_for_ += view.interval;
  if (exceeded_for_ > filter_time_ || !(error <= 2.0 * limit)) {
    return Finding{.kind = Kind::kTrackingError, .value = error, .limit = limit};
  }
  return std::nullopt;
}

}  // namespace twin::motion

#pragma once

#include <cmath>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Tracking error against a limit that grows with the feedrate F:
///
///   |e| <= e_0 + c F
///
/// as LinuxCNC's MIN_FERROR and FERROR have it. The limit may be exceeded for the filter time, as
/// in Beckhoff's position lag monitoring, so that one bad instant is no fault; twice the limit is
/// one at once.
class TrackingError {
 public:
  TrackingError(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
      : least_(settings.tracking_error),
        per_feedrate_(settings.tracking_error_per_feedrate),
        filter_time_(settings.tracking_filter_time) {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    const double error = std::abs(view.command - view.measured);
    const double limit = least_ + per_feedrate_ * std::abs(view.feedrate);
    if (error <= limit) {
      exceeded_for_ = 0.0;
      return std::nullopt;
    }
    exceeded_for_ += view.interval;
    if (exceeded_for_ > filter_time_ || !(error <= 2.0 * limit)) {
      return Finding{Kind::kTrackingError, error, limit};
    }
    return std::nullopt;
  }

 private:
  double least_;               // e_0 [mm]
  double per_feedrate_;        // c [s]
  double filter_time_;         // [s]
  double exceeded_for_ = 0.0;  // [s]
};

}  // namespace twin::motion

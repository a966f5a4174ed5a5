#pragma once

#include <algorithm>
#include <cmath>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// An axis that moves against its drive command: encoder or V-REF turned round.
///
/// With a wrong sign the loop feeds back positively, and the error grows within milliseconds. Two
/// things show it before the error is large, both over the way that the last drive command u
/// [mm/s] cannot explain:
///   the measured position goes against u: w += -dy sign(u), never below 0;
///   the tracking error e is one that u should make smaller: e u > 0.
/// Trips when w exceeds half the limit and |e| the limit, which grows with the feedrate and with
/// what u moves in a period. A sound axis runs against u for some milliseconds after a reversal,
/// because it lags; its error is small then. It also runs on while a period is late and is called
/// back then, so nothing counts for kAfterLate after a late period; the tracking error's limit
/// stands meanwhile.
class Runaway {
 public:
  Runaway(const AxisFacts& axis, const SafetySettings& settings) noexcept
      : period_(axis.period),
        mm_per_s_per_volt_(axis.mm_per_s_per_volt),
        per_feedrate_(settings.runaway_per_feedrate),
        limit_(std::max(settings.runaway, kLeastCounts * std::abs(axis.mm_per_count))) {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    const double step = has_last_ ? view.measured - last_measured_ : 0.0;
    const double u = last_velocity_;
    if (std::abs(u) > kLeastVelocity) {
      wrong_way_ = std::max(0.0, wrong_way_ - std::copysign(1.0, u) * step);
    }
    after_late_ = is_late(view, period_) ? kAfterLate : std::max(0.0, after_late_ - view.interval);
    if (after_late_ > 0.0) {
      wrong_way_ = 0.0;
    }
    has_last_ = true;
    last_measured_ = view.measured;
    last_velocity_ = view.volts * mm_per_s_per_volt_;
    const double error = view.command - view.measured;
    const double limit = limit_ + (per_feedrate_ + period_) * view.feedrate;
    if (wrong_way_ > 0.5 * limit && std::abs(error) > limit && error * last_velocity_ > 0.0) {
      return Finding{Kind::kRunaway, std::abs(error), limit};
    }
    return std::nullopt;
  }

 private:
  static constexpr double kLeastCounts = 4.0;
  static constexpr double kLeastVelocity = 1.0;  // below it u is offset and hum [mm/s]

  static constexpr double kAfterLate = 0.02;  // [s]

  double period_;  // [s]
  double mm_per_s_per_volt_;
  double per_feedrate_;         // [s]
  double limit_;                // at rest [mm]
  double after_late_ = 0.0;     // left of kAfterLate [s]
  double wrong_way_ = 0.0;      // w [mm]
  double last_measured_ = 0.0;  // [mm]
  double last_velocity_ = 0.0;  // u [mm/s]
  bool has_last_ = false;
};

}  // namespace twin::motion

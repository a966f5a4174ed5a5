#include "motion/safety/runaway.hpp"

#include <algorithm>
#include <cmath>

namespace twin::motion {

Runaway::Runaway(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period),
      mm_per_s_per_volt_(axis.mm_per_s_per_volt),
      per_feedrate_(settings.runaway_per_feedrate),
      limit_(std::max(settings.runaway, kLeastCounts * std::abs(axis.mm_per_count))) {}

std::optional<Finding> Runaway::check(const AxisView& view) noexcept {
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
    return Finding{.kind = Kind::kRunaway, .value = std::abs(error), .limit = limit};
  }
  return std::nullopt;
}

}  // namespace twin::motion

#include "motion/safety/count_step.hpp"

#include <algorithm>
#include <cmath>

namespace twin::motion {

CountStep::CountStep(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period),
      speed_(settings.count_step_ratio * axis.feedrate),
      rounding_(2.0 * std::abs(axis.mm_per_count)) {}

std::optional<Finding> CountStep::check(const AxisView& view) noexcept {
  const double step = has_last_ ? std::abs(view.measured - last_) : 0.0;
  const double limit = speed_ * std::max(period_, view.interval) + rounding_;
  has_last_ = true;
  last_ = view.measured;
  if (step > limit) {
    return Finding{.kind = Kind::kCountStep, .value = step, .limit = limit};
  }
  return std::nullopt;
}

}  // namespace twin::motion

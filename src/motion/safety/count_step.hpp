#pragma once

#include <algorithm>
#include <cmath>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// A change of the counts that no motion explains: a counter that was reset, a bad read.
///
/// The largest plausible step of a period is that of a multiple of the largest feedrate, plus what
/// counting rounds off.
class CountStep {
 public:
  CountStep(const AxisFacts& axis, const SafetySettings& settings) noexcept
      : period_(axis.period),
        speed_(settings.count_step_ratio * axis.feedrate),
        rounding_(2.0 * std::abs(axis.mm_per_count)) {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    const double step = has_last_ ? std::abs(view.measured - last_) : 0.0;
    const double limit = speed_ * std::max(period_, view.interval) + rounding_;
    has_last_ = true;
    last_ = view.measured;
    if (step > limit) {
      return Finding{Kind::kCountStep, step, limit};
    }
    return std::nullopt;
  }

 private:
  double period_;    // [s]
  double speed_;     // [mm/s]
  double rounding_;  // [mm]
  double last_ = 0.0;
  bool has_last_ = false;
};

}  // namespace twin::motion

#pragma once

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// A drive command that is cut to +-10 V for too long: the axis cannot follow.
class Saturation {
 public:
  Saturation(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
      : limit_(settings.saturation_time) {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    time_ = view.is_saturated ? time_ + view.interval : 0.0;
    if (time_ > limit_) {
      return Finding{Kind::kSaturation, time_, limit_};
    }
    return std::nullopt;
  }

 private:
  double limit_;       // [s]
  double time_ = 0.0;  // [s]
};

}  // namespace twin::motion

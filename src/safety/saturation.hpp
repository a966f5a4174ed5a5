#pragma once

#include "safety/axis_view.hpp"
#include "safety/settings.hpp"

namespace twin::safety {

/// A drive command that is cut to +-10 V for too long: the axis cannot follow.
class Saturation {
 public:
  Saturation(const AxisFacts& /*axis*/, const Settings& settings) noexcept
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

}  // namespace twin::safety

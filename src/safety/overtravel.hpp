#pragma once

#include "safety/axis_view.hpp"
#include "safety/settings.hpp"

namespace twin::safety {

/// Limit switches P-OT and N-OT.
///
/// A switch that is met trips. One that was met before the first period, as after a stop on it,
/// trips when the set point moves towards it: so the axis can be driven off.
class Overtravel {
 public:
  Overtravel(const AxisFacts& /*axis*/, const Settings& /*settings*/) noexcept {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    if (is_first_) {
      is_first_ = false;
      starts_on_positive_ = view.limit_positive;
      starts_on_negative_ = view.limit_negative;
    }
    starts_on_positive_ = starts_on_positive_ && view.limit_positive;
    starts_on_negative_ = starts_on_negative_ && view.limit_negative;
    if (view.limit_positive && (!starts_on_positive_ || view.velocity > 0.0)) {
      return Finding{Kind::kPositiveLimit, view.measured, 0.0};
    }
    if (view.limit_negative && (!starts_on_negative_ || view.velocity < 0.0)) {
      return Finding{Kind::kNegativeLimit, view.measured, 0.0};
    }
    return std::nullopt;
  }

 private:
  bool is_first_ = true;
  bool starts_on_positive_ = false;
  bool starts_on_negative_ = false;
};

}  // namespace twin::safety

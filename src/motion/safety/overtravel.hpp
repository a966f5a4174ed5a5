#pragma once

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Limit switches P-OT and N-OT.
///
/// A switch that is met trips. One that was met before the first period, as after a stop on it,
/// trips when the set point moves towards it: so the axis can be driven off. It counts as met until
/// it has been closed for kBounce, because switches bounce and an axis at the edge trembles.
class Overtravel {
 public:
  Overtravel(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  static constexpr double kBounce = 0.1;  ///< [s]

  std::optional<Finding> check(const AxisView& view) noexcept {
    if (is_first_) {
      is_first_ = false;
      starts_on_positive_ = view.limit_positive;
      starts_on_negative_ = view.limit_negative;
    }
    closed_ = view.limit_positive || view.limit_negative ? 0.0 : closed_ + view.interval;
    starts_on_positive_ = starts_on_positive_ && closed_ < kBounce;
    starts_on_negative_ = starts_on_negative_ && closed_ < kBounce;
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
  double closed_ = 0.0;  // both switches, for so long [s]
  bool starts_on_positive_ = false;
  bool starts_on_negative_ = false;
};

}  // namespace twin::motion

#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Limit switches P-OT and N-OT.
///
/// A switch that is met trips. Where the axis stands on a switch before the first period, as after
/// a stop on it, the switch trips only when the set point moves towards it, so that the axis can be
/// driven off. The axis counts as on it until the switch has been closed for kBounce, because
/// switches bounce and an axis at the edge trembles.
class Overtravel {
 public:
  Overtravel(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  static constexpr double kBounce = 0.1;  ///< [s]

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  bool is_first_ = true;
  double closed_ = 0.0;  // how long both switches have been closed [s]
  bool starts_on_positive_ = false;
  bool starts_on_negative_ = false;
};

}  // namespace twin::motion

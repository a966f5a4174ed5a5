#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// A drive command that is cut to +-10 V for too long: the axis cannot follow.
class Saturation {
 public:
  Saturation(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double limit_;       // [s]
  double time_ = 0.0;  // [s]
};

}  // namespace twin::motion

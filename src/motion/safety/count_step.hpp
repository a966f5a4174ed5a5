#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// A change of the counts that no motion explains: a counter that was reset, a bad read.
///
/// The largest plausible step of a period is that of a multiple of the largest feedrate, plus what
/// counting rounds off.
class CountStep {
 public:
  CountStep(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double period_;    // [s]
  double speed_;     // [mm/s]
  double rounding_;  // [mm]
  double last_ = 0.0;
  bool has_last_ = false;
};

}  // namespace twin::motion

#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// An axis that moves against its drive command: encoder or V-REF turned round.
///
/// With a wrong sign the loop feeds back positively, and the error grows within milliseconds. Two
/// things show a wrong sign before the error is large; u is the last drive command [mm/s]:
///   the measured position y moves against u; the way w that it has done so is
///     w += -dy sign(u), never below 0                                               [mm]
///   and the tracking error e is one that u should make smaller, e u > 0.
/// The monitor trips when w exceeds half the limit and |e| exceeds the limit. The limit grows with
/// the feedrate and with what u moves in a period.
///
/// A sound axis moves against u for some milliseconds after a reversal, because it lags, but its
/// error is small then. A sound axis also runs on while a period is late, and is called back after
/// it. So nothing counts for kAfterLate after a late period; the limit of the tracking error stands
/// meanwhile.
class Runaway {
 public:
  Runaway(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  static constexpr double kLeastCounts = 4.0;    // least limit at rest [counts]
  static constexpr double kLeastVelocity = 1.0;  // below it u is offset and hum [mm/s]
  static constexpr double kAfterLate = 0.02;     // [s]

  double period_;  // [s]
  double mm_per_s_per_volt_;
  double per_feedrate_;         // [s]
  double limit_;                // at rest [mm]
  double after_late_ = 0.0;     // left of kAfterLate [s]
  double wrong_way_ = 0.0;      // w [mm]
  double last_measured_ = 0.0;  // [mm]
  double last_velocity_ = 0.0;  // u [mm/s]
  bool has_last_ = false;
};

}  // namespace twin::motion

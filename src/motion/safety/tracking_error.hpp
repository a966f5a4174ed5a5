#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Tracking error against a limit that grows with the feedrate F:
///
///   |e| <= e_0 + c F
///
/// as LinuxCNC's MIN_FERROR and FERROR have it. The limit may be exceeded for the filter time, as
/// in Beckhoff's position lag monitoring, so that one bad instant is no fault; twice the limit is
/// one at once.
class TrackingError {
 public:
  TrackingError(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double least_;               // e_0 [mm]
  double per_feedrate_;        // c [s]
  double filter_time_;         // [s]
  double exceeded_for_ = 0.0;  // [s]
};

}  // namespace twin::motion

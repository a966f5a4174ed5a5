#pragma once

#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Drive alarm; a broken wire counts as one where the machine reads its lines that way.
class DriveAlarm {
 public:
  DriveAlarm(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;
};

/// Servo ready that went off after it had come.
class ReadyLost {
 public:
  ReadyLost(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  bool was_ready_ = false;
};

}  // namespace twin::motion

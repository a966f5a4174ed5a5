#pragma once

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Drive alarm; a broken wire counts as one where the machine reads its lines that way.
class DriveAlarm {
 public:
  DriveAlarm(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    return view.alarm ? std::optional(Finding{Kind::kDriveAlarm, 1.0, 0.0}) : std::nullopt;
  }
};

/// Servo ready that went off after it had come.
class ReadyLost {
 public:
  ReadyLost(const AxisFacts& /*axis*/, const SafetySettings& /*settings*/) noexcept {}

  std::optional<Finding> check(const AxisView& view) noexcept {
    const bool is_lost = was_ready_ && !view.servo_ready;
    was_ready_ = was_ready_ || view.servo_ready;
    return is_lost ? std::optional(Finding{Kind::kReadyLost, 0.0, 1.0}) : std::nullopt;
  }

 private:
  bool was_ready_ = false;
};

}  // namespace twin::motion

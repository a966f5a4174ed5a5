#include "motion/safety/drive_state.hpp"

namespace twin::motion {

std::optional<Finding> DriveAlarm::check(const AxisView& view) noexcept {
  return view.alarm ? std::optional(Finding{.kind = Kind::kDriveAlarm, .value = 1.0, .limit = 0.0})
                    : std::nullopt;
}

std::optional<Finding> ReadyLost::check(const AxisView& view) noexcept {
  const bool is_lost = was_ready_ && !view.servo_ready;
  was_ready_ = was_ready_ || view.servo_ready;
  return is_lost ? std::optional(Finding{.kind = Kind::kReadyLost, .value = 0.0, .limit = 1.0})
                 : std::nullopt;
}

}  // namespace twin::motion

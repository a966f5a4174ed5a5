#include "motion/safety/overtravel.hpp"

namespace twin::motion {

std::optional<Finding> Overtravel::check(const AxisView& view) noexcept {
  if (is_first_) {
    is_first_ = false;
    starts_on_positive_ = view.limit_positive;
    starts_on_negative_ = view.limit_negative;
  }
  closed_ = view.limit_positive || view.limit_negative ? 0.0 : closed_ + view.interval;
  starts_on_positive_ = starts_on_positive_ && closed_ < kBounce;
  starts_on_negative_ = starts_on_negative_ && closed_ < kBounce;
  if (view.limit_positive && (!starts_on_positive_ || view.velocity > 0.0)) {
    return Finding{.kind = Kind::kPositiveLimit, .value = view.measured, .limit = 0.0};
  }
  if (view.limit_negative && (!starts_on_negative_ || view.velocity < 0.0)) {
    return Finding{.kind = Kind::kNegativeLimit, .value = view.measured, .limit = 0.0};
  }
  return std::nullopt;
}

}  // namespace twin::motion

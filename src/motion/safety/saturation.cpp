#include "motion/safety/saturation.hpp"

namespace twin::motion {

Saturation::Saturation(const AxisFacts& /*axis*/, const SafetySettings& settings) noexcept
    : limit_(settings.saturation_time) {}

std::optional<Finding> Saturation::check(const AxisView& view) noexcept {
  time_ = view.is_saturated ? time_ + view.interval : 0.0;
  if (time_ > limit_) {
    return Finding{.kind = Kind::kSaturation, .value = time_, .limit = limit_};
  }
  return std::nullopt;
}

}  // namespace twin::motion

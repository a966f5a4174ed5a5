#include "motion/safety/frozen_encoder.hpp"

#include <algorithm>
#include <cmath>

namespace twin::motion {

FrozenEncoder::FrozenEncoder(const AxisFacts& axis, const SafetySettings& settings) noexcept
    : period_(axis.period), limit_(settings.frozen_encoder + 2.0 * std::abs(axis.mm_per_count)) {}

std::optional<Finding> FrozenEncoder::check(const AxisView& view) noexcept {
  if (!has_last_ || view.counts != counts_ || is_late(view, period_)) {
    has_last_ = true;
    counts_ = view.counts;
    lowest_ = highest_ = view.command;
    return std::nullopt;
  }
  lowest_ = std::min(lowest_, view.command);
  highest_ = std::max(highest_, view.command);
  const double way = highest_ - lowest_;
  if (way > limit_) {
    return Finding{.kind = Kind::kEncoderFrozen, .value = way, .limit = limit_};
  }
  return std::nullopt;
}

}  // namespace twin::motion

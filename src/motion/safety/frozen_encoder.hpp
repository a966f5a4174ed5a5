#pragma once

#include <algorithm>
#include <cmath>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Counts that stand while the command moves: a broken encoder wire, a stuck counter.
///
/// Looks at the range that the command has covered since the counts last changed, so that a command
/// that swings within less than a count is none. After a late period it begins anew: the command
/// has gone on by the clock, and the counts may be older than that.
class FrozenEncoder {
 public:
  FrozenEncoder(const AxisFacts& axis, const SafetySettings& settings) noexcept
      : period_(axis.period), limit_(settings.frozen_encoder + 2.0 * std::abs(axis.mm_per_count)) {}

  std::optional<Finding> check(const AxisView& view) noexcept {
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
      return Finding{Kind::kEncoderFrozen, way, limit_};
    }
    return std::nullopt;
  }

 private:
  double period_;         // [s]
  double limit_;          // [mm]
  double lowest_ = 0.0;   // command since the counts changed [mm]
  double highest_ = 0.0;  // [mm]
  std::int64_t counts_ = 0;
  bool has_last_ = false;
};

}  // namespace twin::motion

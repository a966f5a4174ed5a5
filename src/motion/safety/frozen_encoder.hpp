#pragma once

#include <cstdint>
#include <optional>

#include "motion/safety/axis_view.hpp"
#include "motion/safety/safety_settings.hpp"

namespace twin::motion {

/// Counts that stand while the command moves: a broken encoder wire, a stuck counter.
///
/// The monitor looks at the range that the command has covered since the counts last changed, so
/// that a command that swings within less than a count does not trip it. After a late period it
/// begins anew: the command has gone on by the clock, and the counts may be older than that.
class FrozenEncoder {
 public:
  FrozenEncoder(const AxisFacts& axis, const SafetySettings& settings) noexcept;

  /// Looks at a period. Real-time safe.
  std::optional<Finding> check(const AxisView& view) noexcept;

 private:
  double period_;         // [s]
  double limit_;          // [mm]
  double lowest_ = 0.0;   // command since the counts changed [mm]
  double highest_ = 0.0;  // [mm]
  std::int64_t counts_ = 0;
  bool has_last_ = false;
};

}  // namespace twin::motion

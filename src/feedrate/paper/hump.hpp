#pragma once

#include <vector>

#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// The fastest motion between two anchors under one cap: ramp up, hold, ramp down, the ramps as the
/// acceleration profile has them.
///
///        peak  ________
///             /        \.           up    from a.s to a.s + up
///     a.v ___/          \           hold  at the peak feedrate
///                        \___ b.v   down  from b.s - down to b.s
///
/// Up to seven phases; fewer where there is no room for them.
struct Hump {
  Anchor a;
  Anchor b;
  double peak = 0.0;  ///< max(a.v, b.v) <= peak [mm/s]
  double up = 0.0;    ///< distance of the ramp up [mm]
  double down = 0.0;  ///< distance of the ramp down [mm]
};

/// Whether a ramp from one anchor to the other fits between them (to rounding).
bool is_reachable(const Anchor& a, const Anchor& b, const RampLimits& limits) noexcept;

/// The hump between two anchors of which each is reachable from the other.
/// @param cap  >= max(a.v, b.v) [mm/s]
Hump make_hump(const Anchor& a, const Anchor& b, double cap, const RampLimits& limits) noexcept;

/// Part of the path on which a hump is faster than v; empty (begin >= end) where it never is.
struct Interval {
  double begin;  ///< [mm]
  double end;    ///< [mm]
};
Interval faster_than(const Hump& hump, double v, const RampLimits& limits) noexcept;

/// Appends the up to seven phases of a hump.
void append_phases(const Hump& hump, const RampLimits& limits, std::vector<Phase>& phases);

}  // namespace twin::feedrate

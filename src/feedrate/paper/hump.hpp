#pragma once

#include "feedrate/profile/ramp.hpp"

namespace twin::feedrate {

/// A place of the path that is passed at a given feedrate with no tangential acceleration.
struct Knot {
  double s = 0.0;            ///< distance along the path [mm]
  double v = 0.0;            ///< feedrate [mm/s]
  bool is_at_limit = false;  ///< v is the limit of the place, not what its neighbours leave of it
};

/// The fastest motion between two knots under one cap: ramp up, hold, ramp down, the ramps as the
/// acceleration profile has them.
///
///        peak  ________
///             /        \.           up    from a.s to a.s + up
///     a.v ___/          \           hold  at the peak feedrate
///                        \___ b.v   down  from b.s - down to b.s
///
/// Up to seven phases; fewer where there is no room for them.
struct Hump {
  Knot a;
  Knot b;
  double peak = 0.0;  ///< max(a.v, b.v) <= peak [mm/s]
  double up = 0.0;    ///< distance of the ramp up [mm]
  double down = 0.0;  ///< distance of the ramp down [mm]
};

/// Whether a ramp from one knot to the other fits between them (to rounding).
bool is_reachable(const Knot& a, const Knot& b, const RampLimits& limits) noexcept;

/// The hump between two knots of which each is reachable from the other; cap >= max(a.v, b.v)
/// [mm/s].
Hump make_hump(const Knot& a, const Knot& b, double cap, const RampLimits& limits) noexcept;

/// Part of the path on which a hump is faster than v; empty (begin >= end) where it never is.
struct Interval {
  double begin;  ///< [mm]
  double end;    ///< [mm]
};
Interval faster_than(const Hump& hump, double v, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

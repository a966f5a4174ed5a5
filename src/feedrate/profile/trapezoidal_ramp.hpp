#pragma once

#include <algorithm>
#include <cmath>

#include "feedrate/profile/jerk_ramp.hpp"
#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// Ramp of trapezoidal acceleration: the fastest one with |a| <= A, |da/dt| <= J and a = 0 at both
/// ends.
///   tau(D) = 2 sqrt(D / J)     where A is not reached, D <= A^2 / J
///   tau(D) = D / A + A / J     else
/// [WY09, Eqs. 17-18 and 20-21] are the first case; the second adds the phase of constant
/// acceleration, as in the feedrate generation of [WY09, ref. 12].
struct TrapezoidalRamp {
  static double time(double d, const RampLimits& l) noexcept {
    const double a = l.acceleration;
    const double j = l.jerk;
    return d * j <= a * a ? 2.0 * std::sqrt(d / j) : d / a + a / j;
  }

  static RampShape shape(double d, const RampLimits& l) noexcept {
    const double a = l.acceleration;
    const double j = l.jerk;
    return {std::min(0.5 * time(d, l), a / j), std::min(0.5 * d, 0.5 * a * a / j), j, a};
  }

  static double reach(double v1, double distance, const RampLimits& l) noexcept {
    const double a = l.acceleration;
    const double no_hold = a * a / l.jerk;  // largest change without a phase of constant A
    if (0.5 * (v1 + (v1 + no_hold)) * time((v1 + no_hold) - v1, l) >= distance) {
      return v1 + jerk_ramp_change(v1, distance, l.jerk);
    }
    // (v1 + D/2)(D/A + A/J) = distance, a quadratic in D.
    const double p = 2.0 * v1 + no_hold;
    const double q = 2.0 * (v1 * no_hold - a * distance);
    return v1 + 0.5 * (-p + std::sqrt(p * p - 4.0 * q));
  }

  /// (v + w)/2 tau(v - w) is greatest at
  ///   w = v / 3           where A is not reached, 2 v / 3 <= A^2 / J,
  ///   w = A^2 / (2 J)     else.
  static double longest_descent(double v, double w_max, const RampLimits& l) noexcept {
    const double longest = std::min(v / 3.0, 0.5 * l.acceleration * l.acceleration / l.jerk);
    const double w = std::min(w_max, longest);
    return 0.5 * (v + w) * time(std::abs(w - v), l);
  }
};

}  // namespace twin::feedrate

#pragma once

#include <algorithm>
#include <cmath>

#include "feedrate/profile/jerk_ramp.hpp"
#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// Ramp of two phases of jerk, without a phase of constant acceleration, as printed in
/// [WY09, Eqs. 17-21].
///
/// Its acceleration peaks at sqrt(J D). Where that would pass A, D > A^2 / J, the jerk is lowered
/// to A^2 / D, which the paper does not say:
///   tau(D) = 2 max(sqrt(D / J), D / A).
struct SCurveRamp {
  static double time(double d, const RampLimits& l) noexcept {
    return 2.0 * std::max(std::sqrt(d / l.jerk), d / l.acceleration);
  }

  static RampShape shape(double d, const RampLimits& l) noexcept {
    const double rise = 0.5 * time(d, l);
    const double a = l.acceleration;
    const double jerk = d * l.jerk <= a * a ? l.jerk : a * a / d;
    return {rise, 0.5 * d, jerk, jerk * rise};
  }

  static double reach(double v1, double distance, const RampLimits& l) noexcept {
    const double a = l.acceleration;
    const double full = a * a / l.jerk;  // largest change at full jerk
    if ((v1 + 0.5 * full) * time(full, l) >= distance) {
      return v1 + jerk_ramp_change(v1, distance, l.jerk);
    }
    // (v1 + D/2) 2 D/A = distance, a quadratic in D.
    return std::sqrt(v1 * v1 + a * distance);
  }

  /// (v + w)/2 tau(v - w) has two greatest values: at w = v / 3 where the jerk is not lowered,
  /// 2 v / 3 <= A^2 / J, and at w = 0 where it is.
  static double longest_descent(double v, double w_max, const RampLimits& l) noexcept {
    const auto descent = [&](double w) { return 0.5 * (v + w) * time(v - w, l); };
    const double full = l.acceleration * l.acceleration / l.jerk;
    const double w = std::min({w_max, std::max(v / 3.0, v - full), v});
    return std::max(descent(0.0), descent(w));
  }
};

}  // namespace twin::feedrate

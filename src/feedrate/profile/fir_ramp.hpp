#pragma once

#include <algorithm>
#include <cmath>

#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// Ramp of constant acceleration A, filtered by a moving average over T = A / J: the smoothing of
/// the feedrate by a filter of [WY09, ref. 10], with the filter whose jerk is J at most.
///
/// Two rectangles of acceleration, of lengths D / A and T, fold to a trapezoid:
///   tau(D) = D / A + T,  rise = min(D / A, T),  a = A min(1, D / (A T)),
/// and its jerk is J whatever D. From D = A T on it is the trapezoidal ramp.
///
/// However little the feedrate changes, the ramp takes T, and so at v the distance v T; a change of
/// nothing takes none. So the feedrate that can be reached within less than v T is v.
struct FirRamp {
  /// T [s]
  static double filter_time(const RampLimits& l) noexcept { return l.acceleration / l.jerk; }

  static double time(double d, const RampLimits& l) noexcept {
    return d > 0.0 ? d / l.acceleration + filter_time(l) : 0.0;
  }

  static RampShape shape(double d, const RampLimits& l) noexcept {
    const double filter = filter_time(l);
    const double a = std::min(l.acceleration, d / filter);
    return {std::min(d / l.acceleration, filter), 0.5 * a * a / l.jerk, l.jerk, a};
  }

  static double reach(double v1, double distance, const RampLimits& l) noexcept {
    // (v1 + D/2)(D/A + T) = distance, a quadratic in D.
    const double p = 2.0 * v1 + l.acceleration * filter_time(l);
    const double q = 2.0 * l.acceleration * (distance - v1 * filter_time(l));
    return q > 0.0 ? v1 + 2.0 * q / (p + std::sqrt(p * p + 4.0 * q)) : v1;
  }

  /// (v + w)/2 tau(v - w) is greatest at w = A^2 / (2 J), and just below v where v is less.
  static double longest_descent(double v, double w_max, const RampLimits& l) noexcept {
    const double a = l.acceleration;
    const double w = std::min({w_max, 0.5 * a * a / l.jerk, v});
    return 0.5 * (v + w) * ((v - w) / a + filter_time(l));
  }
};

}  // namespace twin::feedrate

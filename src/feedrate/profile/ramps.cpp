#include "feedrate/profile/ramps.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

namespace twin::feedrate {
namespace {

/// Change D of feedrate that a ramp of two phases of jerk J makes within a distance.
///
/// With x = sqrt(D / J), half its time, the ramp from v covers (v + D / 2) 2 x: x is the root of
///   J x^3 + 2 v x = distance.
/// @param v         feedrate at the lower end [mm/s]
/// @param distance  >= 0 [mm]
/// @returns D = J x^2 [mm/s]
double jerk_ramp_change(double v, double distance, double jerk) noexcept {
  double x = std::cbrt(distance / jerk);
  if (v > 0.0) {
    x = std::min(x, distance / (2.0 * v));
  }
  for (int i = 0; i < 60; ++i) {  // Newton from above
    const double f = (jerk * x * x + 2.0 * v) * x - distance;
    const double next = x - f / (3.0 * jerk * x * x + 2.0 * v);
    if (!(std::abs(next - x) > 1e-15 * x)) {
      break;
    }
    x = next;
  }
  return jerk * x * x;
}

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

/// What an acceleration profile has to say of its ramps.
template <class P>
concept RampProfile = requires(double x, const RampLimits& limits) {
  { P::time(x, limits) } -> std::same_as<double>;
  { P::shape(x, limits) } -> std::same_as<RampShape>;
  { P::reach(x, x, limits) } -> std::same_as<double>;
  { P::longest_descent(x, x, limits) } -> std::same_as<double>;
};

/// Calls f with the profile.
template <class F>
auto by_profile(const RampLimits& limits, const F& f) noexcept {
  const auto call = [&]<RampProfile P>(P profile) { return f(profile); };
  switch (limits.profile) {
    case AccelerationProfile::kSCurve:
      return call(SCurveRamp{});
    case AccelerationProfile::kFir:
      return call(FirRamp{});
    case AccelerationProfile::kTrapezoidal:
      break;
  }
  return call(TrapezoidalRamp{});
}

}  // namespace

double ramp_time(double delta, const RampLimits& limits) noexcept {
  return by_profile(limits, [&](auto p) { return p.time(std::abs(delta), limits); });
}

double least_ramp_time(const RampLimits& limits) noexcept {
  return limits.profile == AccelerationProfile::kFir ? FirRamp::filter_time(limits) : 0.0;
}

RampShape ramp_shape(double delta, const RampLimits& limits) noexcept {
  return by_profile(limits, [&](auto p) { return p.shape(std::abs(delta), limits); });
}

double ramp_distance(double v1, double v2, const RampLimits& limits) noexcept {
  return 0.5 * (v1 + v2) * ramp_time(v2 - v1, limits);
}

double ramp_reach(double v1, double distance, const RampLimits& limits) noexcept {
  if (!(distance > 0.0)) {
    return v1;
  }
  return by_profile(limits, [&](auto p) { return p.reach(v1, distance, limits); });
}

double ramp_distance_until(double v1, double v2, double v, const RampLimits& limits) noexcept {
  if (!(v2 > v1)) {
    return 0.0;
  }
  const RampShape shape = ramp_shape(v2 - v1, limits);
  const double j = shape.jerk;
  if (v <= v1 + shape.gain) {
    const double t = std::sqrt(2.0 * std::max(v - v1, 0.0) / j);
    return (v1 + j * t * t / 6.0) * t;
  }
  if (v >= v2 - shape.gain) {
    const double t = std::sqrt(2.0 * std::max(v2 - v, 0.0) / j);
    return ramp_distance(v1, v2, limits) - (v2 - j * t * t / 6.0) * t;
  }
  const double t1 = std::sqrt(2.0 * shape.gain / j);
  const double va = v1 + shape.gain;
  return (v1 + j * t1 * t1 / 6.0) * t1 + (v * v - va * va) / (2.0 * shape.acceleration);
}

double longest_descent(double v, double w_max, const RampLimits& limits) noexcept {
  return by_profile(limits, [&](auto p) { return p.longest_descent(v, w_max, limits); });
}

}  // namespace twin::feedrate

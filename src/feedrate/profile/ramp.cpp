#include "feedrate/profile/ramp.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>

#include "feedrate/profile/fir_ramp.hpp"
#include "feedrate/profile/s_curve_ramp.hpp"
#include "feedrate/profile/trapezoidal_ramp.hpp"

namespace twin::feedrate {
namespace {

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

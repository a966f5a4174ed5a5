#include "feedrate/ramp.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

double ramp_time(double delta, const RampLimits& limits) noexcept {
  const double d = std::abs(delta);
  const double a = limits.acceleration;
  const double j = limits.jerk;
  return d * j <= a * a ? 2.0 * std::sqrt(d / j) : d / a + a / j;
}

double ramp_distance(double v1, double v2, const RampLimits& limits) noexcept {
  return 0.5 * (v1 + v2) * ramp_time(v2 - v1, limits);
}

namespace {

/// Root x >= 0 of j x^3 + 2 v x = d: half the ramp's time where A is not reached, Newton from
/// above.
double half_time_without_hold(double v, double d, double j) noexcept {
  double x = std::cbrt(d / j);
  if (v > 0.0) {
    x = std::min(x, d / (2.0 * v));
  }
  for (int i = 0; i < 60; ++i) {
    const double f = (j * x * x + 2.0 * v) * x - d;
    const double next = x - f / (3.0 * j * x * x + 2.0 * v);
    if (!(std::abs(next - x) > 1e-15 * x)) {
      break;
    }
    x = next;
  }
  return x;
}

}  // namespace

double ramp_reach(double v1, double distance, const RampLimits& limits) noexcept {
  if (!(distance > 0.0)) {
    return v1;
  }
  const double a = limits.acceleration;
  const double j = limits.jerk;
  const double no_hold = a * a / j;  // largest change without a phase of constant acceleration
  if (ramp_distance(v1, v1 + no_hold, limits) >= distance) {
    const double x = half_time_without_hold(v1, distance, j);
    return v1 + j * x * x;
  }
  // (v1 + D/2)(D/a + a/j) = distance, a quadratic in D.
  const double p = 2.0 * v1 + no_hold;
  const double q = 2.0 * (v1 * no_hold - a * distance);
  return v1 + 0.5 * (-p + std::sqrt(p * p - 4.0 * q));
}

double ramp_distance_until(double v1, double v2, double v, const RampLimits& limits) noexcept {
  const double a = limits.acceleration;
  const double j = limits.jerk;
  const double d = v2 - v1;
  const double rise = std::min(0.5 * d, 0.5 * a * a / j);  // change in each of the two jerk phases
  if (v <= v1 + rise) {
    const double t = std::sqrt(2.0 * std::max(v - v1, 0.0) / j);
    return (v1 + j * t * t / 6.0) * t;
  }
  if (v >= v2 - rise) {
    const double t = std::sqrt(2.0 * std::max(v2 - v, 0.0) / j);
    return ramp_distance(v1, v2, limits) - (v2 - j * t * t / 6.0) * t;
  }
  const double t1 = std::sqrt(2.0 * rise / j);
  const double va = v1 + rise;
  return (v1 + j * t1 * t1 / 6.0) * t1 + (v * v - va * va) / (2.0 * a);
}

}  // namespace twin::feedrate

#include "feedrate/paper/hump.hpp"
#include "feedrate/tolerances.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

/// Peak v of a hump of length d without hold: ramp_distance(va, v) + ramp_distance(v, vb) = d.
///
/// The left side grows with v, so the root is bracketed by the larger end feedrate and the cap;
/// regula falsi with bisection where it stalls (Illinois rule). Where it jumps over d, at the
/// larger end feedrate, that is the result.
double peak_without_hold(double va, double vb, double d, double cap,
                         const RampLimits& limits) noexcept {
  const auto excess = [&](double v) {
    return ramp_distance(va, v, limits) + ramp_distance(v, vb, limits) - d;
  };
  double low = std::max(va, vb);
  double high = cap;
  double f_low = excess(low);
  double f_high = excess(high);
  if (f_low >= 0.0) {
    return low;
  }
  for (int i = 0; i < 80 && high - low > 1e-13 * high; ++i) {
    double v = (low * f_high - high * f_low) / (f_high - f_low);
    if (i % 4 == 3 || !(v > low && v < high)) {
      v = 0.5 * (low + high);
    }
    const double f = excess(v);
    if (f > 0.0) {
      high = v;
      f_high = f;
      f_low *= i % 4 == 3 ? 1.0 : 0.5;
    } else {
      low = v;
      f_low = f;
      f_high *= i % 4 == 3 ? 1.0 : 0.5;
      if (f > -1e-12 * d) {
        break;
      }
    }
  }
  return low;
}

}  // namespace

bool is_reachable(const Knot& a, const Knot& b, const RampLimits& limits) noexcept {
  return ramp_distance(a.v, b.v, limits) <= b.s - a.s + kDistanceRounding;
}

Hump make_hump(const Knot& a, const Knot& b, double cap, const RampLimits& limits) noexcept {
  Hump hump{a, b, std::max({cap, a.v, b.v}), 0.0, 0.0};
  const double d = b.s - a.s;
  hump.up = ramp_distance(a.v, hump.peak, limits);
  hump.down = ramp_distance(hump.peak, b.v, limits);
  if (hump.up + hump.down > d) {
    hump.peak = peak_without_hold(a.v, b.v, d, hump.peak, limits);
    hump.up = ramp_distance(a.v, hump.peak, limits);
    hump.down = ramp_distance(hump.peak, b.v, limits);
    // A higher peak is out of reach where even the smallest ramp is too long: the rest is a hold.
    const bool is_level =
        hump.peak == std::max(a.v, b.v) && least_ramp_time(limits) * hump.peak > 0.0;
    const double ramps = hump.up + hump.down;
    if (ramps > d || (ramps > 0.0 && !is_level)) {
      hump.up *= d / ramps;  // rounding of the root, spread over the ramps
      hump.down *= d / ramps;
    }
  }
  return hump;
}

Interval faster_than(const Hump& hump, double v, const RampLimits& limits) noexcept {
  if (v >= hump.peak) {
    return {hump.b.s, hump.a.s};
  }
  Interval interval{hump.a.s, hump.b.s};
  if (v >= hump.a.v) {
    interval.begin += ramp_distance_until(hump.a.v, hump.peak, v, limits);
  }
  if (v >= hump.b.v) {
    interval.end -= ramp_distance_until(hump.b.v, hump.peak, v, limits);
  }
  return interval;
}

}  // namespace twin::feedrate

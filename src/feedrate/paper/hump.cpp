#include "feedrate/paper/hump.hpp"

#include <algorithm>
#include <cmath>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Peak v of a hump of length d without hold: ramp_distance(va, v) + ramp_distance(v, vb) = d.
///
/// The left side grows with v, so the root is bracketed by the larger end feedrate and the cap.
/// Where it jumps over d, at the larger end feedrate, that is the result.
double peak_without_hold(double va, double vb, double d, double cap,
                         const RampLimits& limits) noexcept {
  const auto excess = [&](double v) {
    return ramp_distance(va, v, limits) + ramp_distance(v, vb, limits) - d;
  };
  const double low = std::max(va, vb);
  const double f_low = excess(low);
  if (f_low >= 0.0) {
    return low;
  }
  return root_from_below(excess, low, f_low, cap, excess(cap), {1e-12 * d, 1e-13, 80, 4});
}

/// Appends one ramp that covers `distance` from s: the shape of ramp_shape, stretched by rounding
/// so that it fits.
void append_ramp(double s, double v1, double v2, double distance, const RampLimits& limits,
                 std::vector<Phase>& phases) {
  if (!(distance > 0.0) || v1 == v2) {
    return;
  }
  const double sign = v2 > v1 ? 1.0 : -1.0;
  const double delta = std::abs(v2 - v1);
  const double nominal = ramp_time(delta, limits);
  const double stretch = 2.0 * distance / ((v1 + v2) * nominal);
  const double total = nominal * stretch;
  const double turn = ramp_shape(delta, limits).rise * stretch;
  const double hold = std::max(total - 2.0 * turn, 0.0);
  const double a = sign * delta / (turn + hold);
  Phase phase{turn, s, v1, 0.0, a / turn};
  phases.push_back(phase);
  if (hold > 0.0) {
    phase = remainder_after(phase, turn);
    phase = {hold, phase.s, phase.v, a, 0.0};
    phases.push_back(phase);
    phase = remainder_after(phase, hold);
  } else {
    phase = remainder_after(phase, turn);
  }
  phases.push_back({turn, phase.s, phase.v, a, -a / turn});
}

}  // namespace

bool is_reachable(const Anchor& a, const Anchor& b, const RampLimits& limits) noexcept {
  return ramp_distance(a.v, b.v, limits) <= b.s - a.s + kDistanceRounding;
}

Hump make_hump(const Anchor& a, const Anchor& b, double cap, const RampLimits& limits) noexcept {
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

void append_phases(const Hump& hump, const RampLimits& limits, std::vector<Phase>& phases) {
  append_ramp(hump.a.s, hump.a.v, hump.peak, hump.up, limits, phases);
  const double hold = hump.b.s - hump.a.s - hump.up - hump.down;
  if (hold > 0.0 && hump.peak > 0.0) {
    phases.push_back({hold / hump.peak, hump.a.s + hump.up, hump.peak, 0.0, 0.0});
  }
  append_ramp(hump.b.s - hump.down, hump.peak, hump.b.v, hump.down, limits, phases);
}

}  // namespace twin::feedrate

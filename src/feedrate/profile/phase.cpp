#include "feedrate/profile/phase.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

double time_at(const Phase& phase, double s) noexcept {
  double low = 0.0;
  double high = phase.duration;
  double t = phase.v > 0.0 ? std::clamp((s - phase.s) / phase.v, low, high) : 0.5 * high;
  for (int i = 0; i < 100 && high - low > 1e-15 * phase.duration; ++i) {
    const PathMotion m = motion_at(phase, t);
    const double error = m.s - s;
    if (error == 0.0) {
      break;
    }
    (error > 0.0 ? high : low) = t;
    const double newton = t - error / m.v;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - t) < 1e-16) {
      break;
    }
    t = next;
  }
  return t;
}

Phase remainder_after(const Phase& phase, double t) noexcept {
  const PathMotion m = motion_at(phase, t);
  return {phase.duration - t, m.s, m.v, m.a, phase.j};
}

namespace {

/// Appends one ramp that covers `distance` from s; its shape is that of ramp_shape, stretched to
/// fit to rounding.
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

void append_phases(const Hump& hump, const RampLimits& limits, std::vector<Phase>& phases) {
  append_ramp(hump.a.s, hump.a.v, hump.peak, hump.up, limits, phases);
  const double hold = hump.b.s - hump.a.s - hump.up - hump.down;
  if (hold > 0.0 && hump.peak > 0.0) {
    phases.push_back({hold / hump.peak, hump.a.s + hump.up, hump.peak, 0.0, 0.0});
  }
  append_ramp(hump.b.s - hump.down, hump.peak, hump.b.v, hump.down, limits, phases);
}

}  // namespace twin::feedrate

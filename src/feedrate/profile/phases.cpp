#include "feedrate/profile/phases.hpp"

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

Brake make_brake(const PathMotion& from, const RampLimits& limits) noexcept {
  const double a_max = limits.acceleration;
  const double j = limits.jerk;
  const double a = from.a;
  const double free = std::sqrt(std::max(j * from.v + 0.5 * a * a, 0.0));
  const double peak = std::max(std::min(free, a_max), -a);
  const double hold = free > peak && peak > 0.0
                          ? std::max((from.v + 0.5 * a * a / j - peak * peak / j) / peak, 0.0)
                          : 0.0;
  const std::array<std::array<double, 2>, 3> steps{
      {{(a + peak) / j, -j}, {hold, 0.0}, {peak / j, j}}};
  Brake brake;
  PathMotion at = from;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    brake.phases[i] = {steps[i][0], at.s, at.v, at.a, steps[i][1]};
    at = motion_at(brake.phases[i], steps[i][0]);
    brake.duration += steps[i][0];
  }
  brake.distance = at.s - from.s;
  return brake;
}

}  // namespace twin::feedrate

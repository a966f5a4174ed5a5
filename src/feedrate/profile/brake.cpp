#include "feedrate/profile/brake.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

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

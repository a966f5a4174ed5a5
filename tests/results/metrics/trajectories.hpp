#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

/// Trajectories with known peaks.
namespace twin::results {

/// Distances at every period of a rest-to-rest move with jerk j whose acceleration a and feedrate v
/// are both reached. All phases end on a multiple of the period when the arguments are chosen so.
inline std::vector<double> s_curve(double length, double v, double a, double j, double period) {
  const double tj = a / j;                     // each of the four jerk phases
  const double ta = v / a - tj;                // constant acceleration
  const double tc = length / v - 2 * tj - ta;  // constant feedrate
  const double edges[] = {tj, ta, tj, tc, tj, ta, tj};
  const double jerks[] = {j, 0, -j, 0, -j, 0, j};
  std::vector<double> distances;
  double total = 0.0;
  for (const double e : edges) {
    total += e;
  }
  for (int i = 0; i * period < total + 2 * period; ++i) {
    double t = i * period;
    double s = 0.0;
    double speed = 0.0;
    double acceleration = 0.0;
    for (int phase = 0; phase < 7; ++phase) {
      const double dt = std::clamp(t, 0.0, edges[phase]);
      s += dt * (speed + dt * (acceleration / 2 + dt * jerks[phase] / 6));
      speed += dt * (acceleration + dt * jerks[phase] / 2);
      acceleration += dt * jerks[phase];
      t -= dt;
    }
    distances.push_back(s);
  }
  return distances;
}

}  // namespace twin::results

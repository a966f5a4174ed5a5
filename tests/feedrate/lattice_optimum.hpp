#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::test {

/// The best of all rises from rest under limits that grow along the way, of those whose jerk is J,
/// 0 or -J for whole steps of time: an upper bound of the least time, found by exhaustion.
///
/// With steps h the acceleration is a multiple of J h and the feedrate one of J h^2 / 2. Of two
/// motions with the same feedrate and acceleration at the same time the farther one can do all that
/// the other can, so for each pair only the largest distance counts.
///
/// @returns time lost against the last zone's limit all the way, once it is reached with a = 0 [s]
inline double least_time_lost(const std::vector<feedrate::LimitZone>& zones,
                              const feedrate::RampLimits& limits, double h) {
  const double a_unit = limits.jerk * h;
  const double v_unit = 0.5 * limits.jerk * h * h;
  const auto n_a = static_cast<int>(limits.acceleration / a_unit) + 1;
  const double top = zones.back().limit;
  const auto n_v = static_cast<int>(top / v_unit + 1e-9) + 1;
  const auto limit_before = [&](double s) {
    for (const feedrate::LimitZone& zone : zones) {
      if (s <= zone.end) {
        return zone.limit;
      }
    }
    return top;
  };
  constexpr double kNever = -1.0;
  std::vector<double> now(static_cast<std::size_t>(n_a * n_v), kNever);
  std::vector<double> next(now.size(), kNever);
  const auto at = [&](int a, int v) { return static_cast<std::size_t>(v * n_a + a); };
  now[at(0, 0)] = 0.0;
  double best = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 4000; ++step) {
    std::fill(next.begin(), next.end(), kNever);
    bool goes_on = false;
    for (int v = 0; v < n_v; ++v) {
      for (int a = 0; a < n_a; ++a) {
        const double s = now[at(a, v)];
        if (s < 0.0) {
          continue;
        }
        for (int j = -1; j <= 1; ++j) {
          const int a_next = a + j;
          const int v_next = v + 2 * a + j;
          if (a_next < 0 || a_next >= n_a || v_next >= n_v) {
            continue;
          }
          bool is_allowed = true;
          double s_next = s;
          for (int part = 1; part <= 4 && is_allowed; ++part) {
            const double t = h * part / 4.0;
            s_next = s + t * (v * v_unit + t * (a * a_unit / 2.0 + t * j * limits.jerk / 6.0));
            const double feed = v * v_unit + t * (a * a_unit + t * j * limits.jerk / 2.0);
            is_allowed = feed <= limit_before(s_next) * (1.0 + 1e-9);
          }
          double& known = next[at(a_next, v_next)];
          if (is_allowed && s_next > known) {
            known = s_next;
            goes_on = true;
          }
        }
      }
    }
    std::swap(now, next);
    const double s = now[at(0, n_v - 1)];
    if (s >= 0.0) {
      const double lost = (step + 1) * h - s / top;
      if (lost >= best - 1e-12 && step > 20) {
        break;
      }
      best = std::min(best, lost);
    }
    if (!goes_on) {
      break;
    }
  }
  return best;
}

}  // namespace twin::test

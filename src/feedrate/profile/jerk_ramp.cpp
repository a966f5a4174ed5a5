#include "feedrate/profile/jerk_ramp.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {

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

}  // namespace twin::feedrate

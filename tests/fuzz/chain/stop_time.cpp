#include "tests/fuzz/chain/stop_time.hpp"

#include <algorithm>
#include <cmath>

namespace twin::fuzz {
namespace {

/// Least limit along the path that single axes set: each axis moves by its share of the way.
double along(double limit, const Vec3& axis_limits, const Vec3& direction) {
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (axis_limits[i] > 0.0 && direction[i] > 0.0) {
      limit = std::min(limit, axis_limits[i] / direction[i]);
    }
  }
  return limit;
}

/// V = r Kp sqrt((1 - q^2) / (q^2 - Kf^2)) with q = 1 - eps / r: the first-order servo runs on a
/// circle that is smaller by eps. [WY09, Eq. 4]
double servo_feedrate(double radius, const PlanningModel& model) {
  const double q = 1.0 - model.circular_error / radius;
  return q > model.kf ? radius * model.kp * std::sqrt((1.0 - q * q) / (q * q - model.kf * model.kf))
                      : HUGE_VAL;
}

}  // namespace

double stop_time(double length, const Pace& pace) {
  const auto& [feedrate, a, j] = pace;
  const auto ramp = [a = a, j = j](double v) {
    return v < a * a / j ? 2.0 * std::sqrt(v / j) : v / a + a / j;
  };
  if (feedrate * ramp(feedrate) <= length) {
    return length / feedrate + ramp(feedrate);
  }
  double v = std::cbrt(0.25 * length * length * j);  // 2 v sqrt(v / J) = L
  if (v >= a * a / j) {
    v = 0.5 * a * (std::sqrt(a * a / (j * j) + 4.0 * length / a) - a / j);  // v (v / A + A / J) = L
  }
  return 2.0 * ramp(v);
}

Pace safe_pace(const Limits& limits, const Vec3& direction, double radius, double feedrate,
               double period, double chord, const PlanningModel& model) {
  Pace pace{along(std::min(feedrate, limits.feedrate), limits.axis_feedrate, direction),
            along(limits.acceleration, limits.axis_acceleration, direction),
            along(limits.jerk, limits.axis_jerk, direction)};
  if (!std::isfinite(radius)) {
    return pace;
  }
  const Vec3 all = Vec3::Ones();
  pace.acceleration = 0.5 * along(limits.acceleration, limits.axis_acceleration, all);
  const double j = along(limits.jerk, limits.axis_jerk, all) / 3.0;
  pace.jerk = j;
  double v = std::min(along(pace.feedrate, limits.axis_feedrate, all),
                      std::sqrt(pace.acceleration * radius));
  v = std::min(v, std::cbrt(j * radius * radius));
  if (radius > chord) {
    v = std::min(v, 2.0 / period * std::sqrt(chord * (2.0 * radius - chord)));
  }
  pace.feedrate = std::min(v, servo_feedrate(radius, model));
  v = pace.feedrate;
  pace.acceleration = std::min(pace.acceleration, j * radius / (3.0 * v));
  return pace;
}

}  // namespace twin::fuzz

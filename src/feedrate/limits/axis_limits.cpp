#include "feedrate/limits/axis_limits.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

/// Shares of an axis's acceleration and jerk that the feedrate may use in bends. More makes bends
/// faster and the ramps beside them slower, for the tangential motion gets what is left.
constexpr double kNormalShare = 0.75;
constexpr double kTwistShare = 0.5;

constexpr double kTiny = 1e-12;  // derivative that is none, so that nothing is divided by it

}  // namespace

bool has_axis_limits(const Limits& limits) noexcept {
  return (limits.axis_feedrate.array() > 0.0).any() ||
         (limits.axis_acceleration.array() > 0.0).any() || (limits.axis_jerk.array() > 0.0).any();
}

void keep_axis_limits(const PathBounds& path, const Limits& limits, LimitZone& zone) noexcept {
  for (int i = 0; i < 3; ++i) {
    const double t = path.tangent[i];
    const double k = path.curvature[i];
    const double twist = path.twist[i];
    if (limits.axis_feedrate[i] > 0.0 && t > kTiny) {
      zone.limit = std::min(zone.limit, limits.axis_feedrate[i] / t);
    }
    if (limits.axis_acceleration[i] > 0.0 && k > kTiny) {
      zone.limit = std::min(zone.limit, std::sqrt(kNormalShare * limits.axis_acceleration[i] / k));
    }
    if (limits.axis_jerk[i] > 0.0 && twist > kTiny) {
      zone.limit = std::min(zone.limit, std::cbrt(kTwistShare * limits.axis_jerk[i] / twist));
    }
  }
  const double v = zone.limit;
  for (int i = 0; i < 3; ++i) {
    const double t = path.tangent[i];
    const double k = path.curvature[i];
    const double a_max = limits.axis_acceleration[i];
    if (a_max > 0.0 && t > kTiny) {
      zone.acceleration = std::min(zone.acceleration, (a_max - k * v * v) / t);
    }
    const double rest = limits.axis_jerk[i] - path.twist[i] * v * v * v;
    if (limits.axis_jerk[i] > 0.0 && k > kTiny) {
      zone.acceleration = std::min(zone.acceleration, 0.5 * rest / (3.0 * k * v));
    }
  }
  for (int i = 0; i < 3; ++i) {
    if (limits.axis_jerk[i] > 0.0 && path.tangent[i] > kTiny) {
      const double a = std::isfinite(zone.acceleration) ? zone.acceleration : 0.0;
      const double used = 3.0 * path.curvature[i] * v * std::min(a, limits.acceleration) +
                          path.twist[i] * v * v * v;
      zone.jerk = std::min(zone.jerk, (limits.axis_jerk[i] - used) / path.tangent[i]);
    }
  }
}

}  // namespace twin::feedrate

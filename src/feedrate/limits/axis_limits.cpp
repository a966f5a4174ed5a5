#include "feedrate/limits/axis_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::feedrate {
namespace {

/// Share of an axis's acceleration that the feedrate may use in bends. More makes bends faster and
/// the ramps beside them slower, for the tangential motion gets what is left.
constexpr double kNormalShare = 0.75;

/// Share of an axis's jerk for what bends need of it, on an axis square to the path, and how much
/// less of it on an axis along the path. More makes bends faster, and leaves less jerk for ramps.
constexpr double kBendShare = 0.95;
constexpr double kBendShareAlong = 0.4;

/// Share of that for the feedrate alone, in bends that last and in brief ones. The rest is for the
/// acceleration that adds to it.
constexpr double kTwistShare = 0.95;
constexpr double kBriefTwistShare = 0.97;

/// Tangential acceleration that is left in bends, over that of a ramp from rest to the feedrate of
/// the place with jerk alone, and the share of an axis's jerk that it may use. A larger acceleration
/// makes bends slower, and the ramps in them faster.
constexpr double kRampShare = 0.1;
constexpr double kRampJerkShare = 0.25;

constexpr double kTiny = 1e-12;  // derivative that is none, so that nothing is divided by it

/// Jerk of an axis for what bends need of it [mm/s^3].
double bend_jerk(double along, double jerk) noexcept {
  return (kBendShare - kBendShareAlong * along) * jerk;
}

/// Lowers the feedrate of a zone for one axis.
void keep_feedrate(const PathBounds& path, int axis, const Limits& limits, BendKind bend,
                   LimitZone& zone) noexcept {
  const double t = path.tangent[axis];
  const double k = path.curvature[axis];
  const double twist = path.twist[axis];
  if (limits.axis_feedrate[axis] > 0.0 && t > kTiny) {
    zone.limit = std::min(zone.limit, limits.axis_feedrate[axis] / t);
  }
  if (limits.axis_acceleration[axis] > 0.0 && k > kTiny) {
    zone.limit = std::min(zone.limit, std::sqrt(kNormalShare * limits.axis_acceleration[axis] / k));
  }
  const double jerk = limits.axis_jerk[axis];
  if (jerk > 0.0 && twist > kTiny) {
    const double share = bend == BendKind::kBrief ? kBriefTwistShare : kTwistShare;
    zone.limit = std::min(zone.limit, std::cbrt(share * bend_jerk(t, jerk) / twist));
  }
  if (jerk > 0.0 && k > kTiny) {  // 3 k v a <= share of J, with a = kRampShare sqrt(J v)
    const double root = std::cbrt(kRampJerkShare * std::sqrt(jerk) / (3.0 * kRampShare * k));
    zone.limit = std::min(zone.limit, root * root);
  }
}

/// What a zone allows below its limit: each part is the least over all axes.
///   t a + k v^2 <= A            <=>  a <= A / t (1 - k v^2 / A)
///   3 k v a + k' v^3 <= S       <=>  a <= S / (3 k v) (1 - k' v^3 / S)    S: the axis's jerk for bends
void keep_more_below(const PathBounds& path, const Limits& limits, LimitZone& zone) noexcept {
  zone.most = limits.acceleration;
  zone.power = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double t = path.tangent[i];
    const double k = path.curvature[i];
    if (limits.axis_acceleration[i] > 0.0 && t > kTiny) {
      zone.most = std::min(zone.most, limits.axis_acceleration[i] / t);
      zone.bend = std::max(zone.bend, k / limits.axis_acceleration[i]);
    }
    if (limits.axis_jerk[i] > 0.0 && k > kTiny) {
      const double share = bend_jerk(t, limits.axis_jerk[i]);
      zone.power = std::min(zone.power, share / (3.0 * k));
      const double fade = path.twist[i] / share;
      zone.fade_up = std::max(zone.fade_up, path.trend[i] < 0.0 ? 0.0 : fade);
      zone.fade_down = std::max(zone.fade_down, path.trend[i] > 0.0 ? 0.0 : fade);
    }
  }
  if (zone.bend == 0.0 && std::isinf(zone.power)) {
    zone.most = zone.power = 0.0;
  }
}

/// Largest v (1 - S v^2) of a zone up to its limit, S = `bend` [mm/s].
double largest_share_of_feedrate(const LimitZone& zone) noexcept {
  const double peak =
      zone.bend > 0.0 ? std::min(1.0 / std::sqrt(3.0 * zone.bend), zone.limit) : zone.limit;
  return peak * (1.0 - zone.bend * peak * peak);
}

/// Jerk that bends use up of an axis at most, at any feedrate up to the zone's limit V, with the
/// acceleration a(v) that the zone allows there (ramp_levels.hpp) [mm/s^3].
///
/// With a_V it is the most at V. What more is allowed below keeps M (1 - S v^2) and P (1 - R v^3) / v:
/// by the first 3 k v a is M times the largest v (1 - S v^2), which may lie below V; by the second
/// all of it is the axis's jerk for bends.
double bend_jerk_used(const PathBounds& path, int axis, const Limits& limits,
                      const LimitZone& zone) noexcept {
  const double k = path.curvature[axis];
  const double v = zone.limit;
  const double twist = path.twist[axis] * v * v * v;
  if (!(k > kTiny)) {  // no acceleration is limited, and none uses up jerk
    return twist;
  }
  const auto used_with = [&](double product, bool adds) {  // v a
    return adds ? 3.0 * k * product + twist : std::max(3.0 * k * product, twist);
  };
  const double most = bend_jerk(path.tangent[axis], limits.axis_jerk[axis]);
  const double below = zone.most * largest_share_of_feedrate(zone);
  const auto used = [&](double acceleration, bool adds) {
    const double at_limit = used_with(v * std::min(acceleration, limits.acceleration), adds);
    return std::max(at_limit, std::min(used_with(below, adds), most));
  };
  return std::max(used(zone.acceleration, path.trend[axis] >= 0.0),
                  used(zone.deceleration, path.trend[axis] <= 0.0));
}

}  // namespace

bool has_axis_limits(const Limits& limits) noexcept {
  return (limits.axis_feedrate.array() > 0.0).any() ||
         (limits.axis_acceleration.array() > 0.0).any() || (limits.axis_jerk.array() > 0.0).any();
}

void keep_axis_limits(const PathBounds& path, const Limits& limits, BendKind bend,
                      LimitZone& zone) noexcept {
  for (int i = 0; i < 3; ++i) {
    keep_feedrate(path, i, limits, bend, zone);
  }
  const double v = zone.limit;
  for (int i = 0; i < 3; ++i) {
    const double t = path.tangent[i];
    const double k = path.curvature[i];
    const double most = limits.axis_acceleration[i];
    if (most > 0.0 && t > kTiny) {
      const double rest = (most - k * v * v) / t;
      zone.acceleration = std::min(zone.acceleration, rest);
      zone.deceleration = std::min(zone.deceleration, rest);
    }
    if (limits.axis_jerk[i] > 0.0 && k > kTiny) {
      const double share = bend_jerk(t, limits.axis_jerk[i]);
      const double rest = share - path.twist[i] * v * v * v;
      const double speeding_up = (path.trend[i] < 0.0 ? share : rest) / (3.0 * k * v);
      const double braking = (path.trend[i] > 0.0 ? share : rest) / (3.0 * k * v);
      zone.acceleration = std::min(zone.acceleration, speeding_up);
      zone.deceleration = std::min(zone.deceleration, braking);
    }
  }
  keep_more_below(path, limits, zone);
  for (int i = 0; i < 3; ++i) {
    if (limits.axis_jerk[i] > 0.0 && path.tangent[i] > kTiny) {
      const double used = bend_jerk_used(path, i, limits, zone);
      zone.jerk = std::min(zone.jerk, (limits.axis_jerk[i] - used) / path.tangent[i]);
    }
  }
}

}  // namespace twin::feedrate

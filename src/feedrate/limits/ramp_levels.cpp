#include "feedrate/limits/ramp_levels.hpp"

#include <algorithm>
#include <cmath>

namespace twin::feedrate {
namespace {

/// Ratio of neighbouring levels. A larger one leaves less of the acceleration, a smaller one makes more
/// phases: 1.12 instead makes twice as many.
constexpr double kLevelStep = 1.25;

/// The last level but one where the bend takes some of M at any feedrate, as a share of M.
constexpr double kNearMost = 0.95;

constexpr double kLeastStep = 1e-6;  // share of M that is no step

/// Steps of Newton's method for a feedrate; the function is convex, and it ends on the safe side.
constexpr int kNewtonSteps = 30;

/// The feedrate up to which P (1 - R v^3) / v is no less than an acceleration a: the root of
///   f(v) = P - P R v^3 - a v,
/// which is concave and falls. From above, Newton's method stays above the root, and the chord from
/// a lower end stays below; the lower end is the result.
double feedrate_of_power(double power, double fade, double acceleration) {
  if (std::isinf(power)) {
    return power;
  }
  const auto f = [&](double v) { return power - v * (acceleration + power * fade * v * v); };
  double low = 0.0;
  double high = power / acceleration;
  if (fade > 0.0) {
    high = std::min(high, std::cbrt(1.0 / fade));
  }
  for (int i = 0; i < kNewtonSteps && high - low > 1e-9 * high; ++i) {
    high += f(high) / (acceleration + 3.0 * power * fade * high * high);
    const double below = f(low);
    low += (high - low) * below / (below - std::min(f(high), -1e-300));
  }
  return low;
}

/// The feedrate up to which a(v) is no less than an acceleration.
double feedrate_of(const LimitZone& zone, double fade, double acceleration) {
  const double by_bend = zone.bend > 0.0
                             ? std::sqrt(std::max(1.0 - acceleration / zone.most, 0.0) / zone.bend)
                             : std::numeric_limits<double>::infinity();
  return std::min({feedrate_of_power(zone.power, fade, acceleration), by_bend, zone.limit});
}

}  // namespace

void append_ramp_levels(const LimitZone& zone, Sense sense, const RampLimits& ramp,
                        std::vector<RampLevel>& levels) {
  const bool is_up = sense == Sense::kForward;
  double a = std::min(is_up ? zone.acceleration : zone.deceleration, ramp.acceleration);
  const double most = std::min(zone.most, ramp.acceleration);
  const double fade = is_up ? zone.fade_up : zone.fade_down;
  const std::size_t first = levels.size();
  levels.push_back({std::numeric_limits<double>::infinity(), a});
  while (a < most * (1.0 - kLeastStep)) {
    // The last level is all of M, which without S is there up to some feedrate.
    a = std::min(a * kLevelStep, zone.bend > 0.0 && a < kNearMost * most ? kNearMost * most : most);
    const double top = feedrate_of(zone, fade, a);
    if (!(top > 0.0)) {
      break;
    }
    levels.push_back({top, a});
  }
  std::reverse(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end());
}

}  // namespace twin::feedrate

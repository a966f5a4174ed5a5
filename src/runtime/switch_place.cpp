#include "runtime/switch_place.hpp"

#include <algorithm>
#include <cmath>

namespace twin::runtime {
namespace {

constexpr double kRest = 1e-9;  // feedrate that is none [mm/s]

/// Time into a phase, from `low` on, at which there is no acceleration.
std::optional<double> level_time(const feedrate::Phase& phase, double low, double tolerance) {
  if (low > phase.duration) {
    return std::nullopt;
  }
  const auto is_level = [&](double t) { return std::abs(phase.a + phase.j * t) <= tolerance; };
  if (is_level(low)) {
    return low;
  }
  const double crossing = phase.j != 0.0 ? -phase.a / phase.j : -1.0;
  if (crossing > low && crossing < phase.duration) {
    return crossing;
  }
  return is_level(phase.duration) ? std::optional(phase.duration) : std::nullopt;
}

}  // namespace

std::optional<SwitchPlace> find_switch_place(const std::deque<SegmentPhases>& plan,
                                             const motion::PlanPlace& from, double margin,
                                             double tolerance) {
  double passed = 0.0;  // since `from`
  for (const SegmentPhases& segment : plan) {
    if (segment.index < from.segment) {
      continue;
    }
    const bool is_first = segment.index == from.segment;
    const std::size_t count = segment.phases.size();
    for (std::size_t i = is_first ? from.phase : 0; i < count; ++i) {
      const feedrate::Phase& phase = segment.phases[i];
      const double begin = is_first && i == from.phase ? from.time : 0.0;
      const double low = std::max(begin, begin + margin - passed);
      const bool is_rest = segment.length == 0.0;
      auto t = level_time(phase, is_rest ? std::max(low, phase.duration) : low, tolerance);
      if (t) {
        const feedrate::PathMotion m = feedrate::motion_at(phase, *t);
        const bool is_at_end = is_rest || (i + 1 == count && *t == phase.duration);
        const double v = m.v > kRest ? m.v : 0.0;
        if (is_at_end || m.s < segment.length - kSegmentEnd) {
          return SwitchPlace{.segment = segment.index,
                             .phase = i,
                             .time = *t,
                             .is_at_end = is_at_end,
                             .s = m.s,
                             .v = v,
                             .after = passed + *t - begin};
        }
      }
      passed += phase.duration - begin;
    }
  }
  return std::nullopt;
}

}  // namespace twin::runtime

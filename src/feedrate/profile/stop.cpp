#include "feedrate/profile/stop.hpp"

#include <algorithm>
#include <optional>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Halvings of the range of a feedrate: as many as its digits, so that more would change nothing.
constexpr int kHalvings = 53;

/// The brake of a motion that has `lowest` more feedrate all along: to that feedrate.
Brake brake_to(const PathMotion& from, double lowest, const RampLimits& limits) noexcept {
  Brake brake = make_brake({from.s, from.v - lowest, from.a}, limits);
  double before = 0.0;  // time of the phases before [s]
  for (Phase& phase : brake.phases) {
    phase.v += lowest;
    phase.s += lowest * before;
    before += phase.duration;
  }
  brake.distance += lowest * brake.duration;
  return brake;
}

/// Ends a brake at a place that it passes.
void cut_at(Brake& brake, double s) noexcept {
  const double begin = brake.phases.front().s;
  std::optional<PathMotion> end;
  brake.duration = 0.0;
  for (Phase& phase : brake.phases) {
    if (end) {
      phase = {0.0, s, end->v, end->a, 0.0};
    } else if (motion_at(phase, phase.duration).s >= s) {
      phase.duration = time_at(phase, s);
      end = motion_at(phase, phase.duration);
    }
    brake.duration += phase.duration;
  }
  brake.distance = s - begin;
}

}  // namespace

PathMotion end_of(const Brake& brake) noexcept {
  for (std::size_t i = brake.phases.size(); i-- > 0;) {
    if (brake.phases[i].duration > 0.0) {
      PathMotion end = motion_at(brake.phases[i], brake.phases[i].duration);
      end.s = brake.phases.front().s + brake.distance;
      return end;
    }
  }
  return {brake.phases.front().s, brake.phases.front().v, brake.phases.front().a};
}

Brake make_slowdown(const PathMotion& from, const RampLimits& limits, double distance) noexcept {
  // Without more deceleration than it takes to lose the present acceleration, in the shortest way.
  double high = std::max(from.v + (from.a > 0.0 ? 0.5 : -0.5) * from.a * from.a / limits.jerk, 0.0);
  double low = 0.0;
  Brake brake = brake_to(from, high, limits);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const Brake tried = brake_to(from, middle, limits);
    const bool is_too_low = tried.distance > distance;
    (is_too_low ? low : high) = middle;
    if (!is_too_low) {
      brake = tried;
    }
  }
  // What is left of the distance is passed without acceleration, which is rounding.
  brake.distance = distance;
  return brake;
}

StopPart make_stop_part(const PathMotion& from, const Stretch& stretch) noexcept {
  StopPart part{make_brake(from, stretch.ramp), true};
  const double room = stretch.end - from.s;
  if (part.brake.distance <= room + kRestRounding) {
    return part;
  }
  part.rests = false;
  if (stretch.is_harder_after) {
    cut_at(part.brake, stretch.end);
  } else {
    part.brake = make_slowdown(from, stretch.ramp, room);
  }
  return part;
}

}  // namespace twin::feedrate

#include "feedrate/profile/stop.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Halvings of the range of a feedrate: as many as its digits, so that more would change nothing.
constexpr int kHalvings = 53;

/// -J and a constant deceleration A for a time, then +J until a = 0, then no acceleration, as far as
/// a distance goes.
struct Lowering {
  std::array<Phase, 4> phases{};
  PathMotion end{};

  Lowering(const PathMotion& from, const RampLimits& limits, double time,
           double distance) noexcept {
    const double build_up = (from.a + limits.acceleration) / limits.jerk;
    const double first = std::clamp(time, 0.0, std::max(build_up, 0.0));
    PathMotion at = from;
    append(0, first, -limits.jerk, from.s + distance, at);
    append(1, time - first, 0.0, from.s + distance, at);
    append(2, std::max(-at.a, 0.0) / limits.jerk, limits.jerk, from.s + distance, at);
    const double left = from.s + distance - at.s;
    append(3, left > 0.0 && at.v > 0.0 ? left / at.v : 0.0, 0.0, from.s + distance, at);
    end = at;
  }

 private:
  /// Appends a phase that ends where the distance or the feedrate does, if not before.
  void append(std::size_t i, double time, double jerk, double last, PathMotion& at) noexcept {
    Phase& phase = phases[i];
    phase = {at.s < last && at.v > 0.0 ? time : 0.0, at.s, at.v, at.a, jerk};
    const double square = at.a * at.a - 2.0 * jerk * at.v;
    if (at.a < 0.0 || jerk < 0.0) {  // v falls: v + a t + j t^2 / 2 = 0
      const double root = -at.a + std::sqrt(std::max(square, 0.0));
      const double rest = square >= 0.0 && root > 0.0 ? 2.0 * at.v / root : phase.duration;
      if (rest < phase.duration) {
        phase.duration = rest;
        at = motion_at(phase, rest);
        at.v = 0.0;
        if (at.s <= last) {
          return;
        }
        at = {phase.s, phase.v, phase.a};
      }
    }
    if (motion_at(phase, phase.duration).s > last) {
      phase.duration = time_at(phase, last);
    }
    at = motion_at(phase, phase.duration);
  }
};

/// -J until a = 0.
Brake way_out(const PathMotion& from, double jerk) noexcept {
  Brake brake;
  const double time = std::max(from.a, 0.0) / jerk;
  brake.phases[0] = {time, from.s, from.v, from.a, -jerk};
  const PathMotion end = motion_at(brake.phases[0], time);
  brake.phases[1] = brake.phases[2] = {0.0, end.s, end.v, 0.0, 0.0};
  brake.duration = time;
  brake.distance = end.s - from.s;
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

/// Constant feedrate over a distance.
Brake make_hold(const PathMotion& from, double distance) noexcept {
  Brake brake;
  brake.phases[0] = {distance / from.v, from.s, from.v, 0.0, 0.0};
  brake.phases[1] = brake.phases[2] = {0.0, from.s + distance, from.v, 0.0, 0.0};
  brake.distance = distance;
  brake.duration = brake.phases[0].duration;
  return brake;
}

/// To rest where J is too little to lose the deceleration before the feedrate: with the jerk that does.
Brake rest_at_once(const PathMotion& from, const RampLimits& limits) noexcept {
  RampLimits harder = limits;
  harder.jerk = std::max(limits.jerk, 0.5 * from.a * from.a / from.v);
  return make_brake(from, harder);
}

/// Share of a feedrate near rest that is rounding of the parts before [-]. Where the plan loses its
/// last feedrate with J, a stop that follows it is no slower than this.
constexpr double kTailRounding = 1e-6;

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

bool can_rest(const PathMotion& from, double jerk) noexcept {
  return from.a >= 0.0 || from.a * from.a <= 2.0 * jerk * from.v * (1.0 + kTailRounding);
}

std::optional<Brake> make_slowdown(const PathMotion& from, const RampLimits& limits,
                                   double distance, double fall) noexcept {
  // With -J for longer the deceleration at the end is larger, and the feedrate lower.
  double low = std::max(from.a, 0.0) / limits.jerk;
  double high = low + from.v / limits.acceleration + limits.acceleration / limits.jerk;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const PathMotion end = Lowering(from, limits, middle, distance).end;
    const double most = fall * end.v * end.v + kFormulaRounding * limits.acceleration;
    const bool is_too_low = end.v <= 0.0 || end.a < -most;
    (is_too_low ? high : low) = middle;
  }
  const Lowering lowest(from, limits, low, distance);
  if (lowest.end.v <= 0.0) {
    return std::nullopt;
  }
  Brake brake;
  for (std::size_t i = 0; i < brake.phases.size(); ++i) {
    brake.phases[i] = lowest.phases[i];
    brake.duration += brake.phases[i].duration;
  }
  // What is left of the distance is passed without acceleration, which is rounding.
  brake.distance = distance;
  return brake;
}

StopPart make_stop_part(const PathMotion& from, const Stretch& stretch) noexcept {
  const double room = stretch.end - from.s;
  if (from.v <= kRestFeedrate) {
    return {make_hold({from.s, kRestFeedrate, 0.0}, 0.0), true};
  }
  if (from.v > stretch.held_above) {
    return {make_hold(from, std::max(room, 0.0)), false};
  }
  StopPart part{make_brake(from, stretch.ramp), true};
  const bool may_rest = can_rest(from, stretch.ramp.jerk);
  if (may_rest && part.brake.distance <= room + kRestRounding) {
    return part;
  }
  part.rests = false;
  if (may_rest && stretch.is_harder_after) {
    cut_at(part.brake, stretch.end);
    return part;
  }
  const Brake out = way_out(from, stretch.ramp.jerk);
  if (from.a > 0.0 && out.distance >= room) {
    part.brake = out;
    cut_at(part.brake, stretch.end);
    return part;
  }
  const auto slowdown = make_slowdown(from, stretch.ramp, room, stretch.fall);
  return slowdown ? StopPart{*slowdown, false} : StopPart{rest_at_once(from, stretch.ramp), true};
}

}  // namespace twin::feedrate

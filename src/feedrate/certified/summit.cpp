#include "feedrate/certified/summit.hpp"

#include <algorithm>
#include <cmath>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

void append(std::vector<Phase>& phases, PathMotion& at, double duration, double jerk) {
  if (duration > 0.0) {
    phases.push_back({duration, at.s, at.v, at.a, jerk});
    at = motion_at(phases.back(), duration);
  }
}

}  // namespace

std::optional<Summit> join(Ascent& up, Ascent& down, double length, double v_least, double cap) {
  Summit summit;
  const auto room_at = [&](double v) {
    summit.up = up.exit_at(v);
    summit.down = down.exit_at(v);
    return length - summit.up.distance - summit.down.distance;
  };
  summit.length = length;
  while (true) {
    Ascent& lower = up.top() < down.top() ? up : down;
    const double v = lower.top();
    if (lower.is_complete() || v >= cap || (v >= v_least && room_at(v) <= 0.0)) {
      break;
    }
    lower.extend();
  }
  double high = std::min({up.top(), down.top(), cap});
  if (high < v_least) {
    if (high < v_least * (1.0 - kFormulaRounding)) {
      return std::nullopt;
    }
    high = v_least;
  }
  summit.v = high;
  const double room_high = room_at(high);
  if (room_high >= 0.0) {
    return summit;
  }
  const double room_low = room_at(v_least);
  summit.v = v_least;
  if (room_low < 0.0) {
    return room_low >= -kDistanceRounding ? std::optional(summit) : std::nullopt;
  }
  const auto missing_at = [&](double v) { return -room_at(v); };
  summit.v = root_from_below(missing_at, v_least, -room_low, high, -room_high,
                             {0.1 * kDistanceRounding, 1e-14, 100, 3});
  return room_at(summit.v) >= 0.0 ? std::optional(summit) : std::nullopt;
}

std::size_t append_phases(const Summit& summit, const Ascent& up, const Ascent& down, double s0,
                          double jerk, std::vector<Phase>& phases) {
  for (std::size_t i = 0; i < summit.up.phase && i < up.phases().size(); ++i) {
    phases.push_back(up.phases()[i]);
    phases.back().s += s0;
  }
  PathMotion at = summit.up.at;
  at.s += s0;
  if (summit.up.phase < up.phases().size() && summit.up.time > 0.0) {
    phases.push_back(up.phases()[summit.up.phase]);
    phases.back().s += s0;
    phases.back().duration = summit.up.time;
  }
  append(phases, at, at.a / jerk, -jerk);
  const double room = summit.length - summit.up.distance - summit.down.distance;
  at = {s0 + summit.up.distance, summit.v, 0.0};
  if (summit.v > 0.0) {
    append(phases, at, room / summit.v, 0.0);
  }
  const std::size_t descent = phases.size();
  const double end = s0 + summit.length;
  const auto mirrored = [&](const Phase& phase, double time) {
    const PathMotion last = motion_at(phase, time);
    if (time > 0.0) {
      phases.push_back({time, end - last.s, last.v, -last.a, phase.j});
    }
  };
  const Phase leave{summit.down.at.a / jerk, summit.down.at.s, summit.down.at.v, summit.down.at.a,
                    -jerk};
  mirrored(leave, leave.duration);
  if (summit.down.phase < down.phases().size()) {
    mirrored(down.phases()[summit.down.phase], summit.down.time);
  }
  for (std::size_t i = std::min(summit.down.phase, down.phases().size()); i-- > 0;) {
    mirrored(down.phases()[i], down.phases()[i].duration);
  }
  return descent;
}

}  // namespace twin::feedrate

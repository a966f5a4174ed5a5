#include "feedrate/certified/summit.hpp"

#include <algorithm>
#include <cmath>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
std::optional<Summit> join(Rise& up, Rise& down, double length, double v_least, double cap) {
  Summit summit;
  const auto room_at = [&](double v) {
    summit.up = up.exit_at(v);
    summit.down = down.exit_at(v);
    return length - summit.up.distance - summit.down.distance;
  };
  summit.length = length;
  while (true) {
    Rise& lower = up.top() < down.top() ? up : down;
    const double v = lower.top();
    if (lower.is_complete() || v >= cap || (v >= v_least && room_at(v) <= 0.0)) {
      break;
    }
    const std::size_t phases = lower.phases().size();
    const double reached = lower.reached();
    lower.extend();
    if (lower.phases().size() == phases && lower.reached() <= reached && lower.top() <= v) {
      break;  // rounding leaves nothing that it could be extended by
    }
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

std::size_t append_phases(const Summit& summit, const Rise& up, const Rise& down, double s0,
                          std::vector<Phase>& phases) {
  for (std::size_t i = 0; i < summit.up.phase && i < up.phases().size(); ++i) {
    phases.push_back(up.phases()[i]);
    phases.back().s += s0;
  }
  if (summit.up.phase < up.phases().size() && summit.up.time > 0.0) {
    phases.push_back(up.phases()[summit.up.phase]);
    phases.back().s += s0;
    phases.back().duration = summit.up.time;
  }
  const std::size_t leaving = phases.size();
  up.append_way_out(summit.up, phases);
  for (std::size_t i = leaving; i < phases.size(); ++i) {
    phases[i].s += s0;
  }
  const double room = summit.length - summit.up.distance - summit.down.distance;
  if (summit.v > 0.0 && room / summit.v > 0.0) {
    phases.push_back({room / summit.v, s0 + summit.up.distance, summit.v, 0.0, 0.0});
  }
  const std::size_t descent = phases.size();
  const double end = s0 + summit.length;
  const auto mirrored = [&](const Phase& phase, double time) {
    const PathMotion last = motion_at(phase, time);
    if (time > 0.0) {
      phases.push_back({time, end - last.s, last.v, -last.a, phase.j});
    }
  };
  down.append_way_out(summit.down, phases);
  std::reverse(phases.begin() + static_cast<std::ptrdiff_t>(descent), phases.end());
  for (std::size_t i = descent; i < phases.size(); ++i) {
    const Phase& phase = phases[i];
    const PathMotion last = motion_at(phase, phase.duration);
    phases[i] = {phase.duration, end - last.s, last.v, -last.a, phase.j};
  }
  if (summit.down.phase < down.phases().size()) {
    mirrored(down.phases()[summit.down.phase], summit.down.time);
  }
  for (std::size_t i = std::min(summit.down.phase, down.phases().size()); i-- > 0;) {
    mirrored(down.phases()[i], down.phases()[i].duration);
  }
  return descent;
}

}  // namespace twin::feedrate

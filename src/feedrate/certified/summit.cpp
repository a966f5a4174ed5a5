#include "feedrate/certified/summit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/root.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Newton steps before the search goes on without slopes. Rounding of the distance may hide the root.
constexpr int kJoinSteps = 30;

/// Newton steps for a first guess of the feedrate, which cost next to nothing.
constexpr int kGuesses = 6;

/// Root of -at_zero + c (b x + x^3) in [0, x_high], where it has the value at_high: the distance of a
/// ramp from and to the feedrate b / 2. Three digits are enough.
double guess(double b, double at_zero, double x_high, double at_high) noexcept {
  const double c = (at_high + at_zero) / (x_high * (b + x_high * x_high));
  double x = x_high;
  for (int i = 0; i < kGuesses; ++i) {
    x -= (c * x * (b + x * x) - at_zero) / (c * (b + 3.0 * x * x));
  }
  return x;
}

/// Feedrate between two others at which `missing`, the distance that is missing, is just below 0.
/// Near an anchor of the feedrate v_least the distance is that of a ramp, (v_least + v) x / sqrt(J)
/// with x = sqrt(v - v_least), which has no slope at v_least but is smooth in x.
/// @param missing  callable as missing(v) -> value and slope
/// @param at_least, at_high  missing at v_least and at high; no slope, NaN, where it is not known
template <class Function>
double highest_with_room(const Function& missing, double v_least, double at_least, double high,
                         const ValueAndSlope& at_high) noexcept {
  if (!std::isnan(at_high.slope)) {
    constexpr double kHalf = 0.05 * kDistanceRounding;
    const auto at = [&](double x) {
      const ValueAndSlope f = missing(v_least + x * x);
      return ValueAndSlope{f.value + kHalf, 2.0 * x * f.slope};
    };
    const double x_high = std::sqrt(high - v_least);
    const double first = guess(2.0 * v_least, -at_least, x_high, at_high.value);
    const NewtonRoot root =
        bracketed_newton(at, 0.0, x_high, first, {.value = kHalf, .iterations = kJoinSteps});
    if (root.is_met) {
      return v_least + root.x * root.x;
    }
  }
  return root_from_below([&](double v) { return missing(v).value; }, v_least, at_least, high,
                         at_high.value, {0.1 * kDistanceRounding, 1e-14, 100, 3});
}

}  // namespace

bool extend(Rise& rise) {
  const std::size_t phases = rise.phases().size();
  const double reached = rise.reached();
  const double top = rise.top();
  rise.extend();
  return rise.phases().size() != phases || rise.reached() > reached || rise.top() > top;
}

std::optional<Summit> join(Rise& up, Rise& down, double length, double v_least, double cap) {
  Summit summit;
  double last = std::numeric_limits<double>::quiet_NaN();  // feedrate that was asked for last
  double room = 0.0;
  const auto room_at = [&](double v) {
    if (v != last) {
      summit.up = up.exit_at(v);
      summit.down = down.exit_at(v);
      room = length - summit.up.distance - summit.down.distance;
      last = v;
    }
    return room;
  };
  summit.length = length;
  while (true) {
    Rise& lower = up.top() < down.top() ? up : down;
    const double v = lower.top();
    if (lower.is_complete() || v >= cap || (v >= v_least && room_at(v) <= 0.0)) {
      break;
    }
    last = std::numeric_limits<double>::quiet_NaN();
    if (!extend(lower)) {
      break;
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
  const ValueAndSlope at_high{-room_high, summit.up.slope + summit.down.slope};
  const double room_low = room_at(v_least);
  summit.v = v_least;
  if (room_low < 0.0) {
    return room_low >= -kDistanceRounding ? std::optional(summit) : std::nullopt;
  }
  const auto missing_at = [&](double v) {
    const double missing = -room_at(v);
    return ValueAndSlope{missing, summit.up.slope + summit.down.slope};
  };
  summit.v = highest_with_room(missing_at, v_least, -room_low, high, at_high);
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

#include "feedrate/paper/hump_planner.hpp"
#include "feedrate/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::feedrate {
namespace {

/// Zones between the window's start and a place.
std::span<const LimitZone> zones_until(const Window& window, double last) {
  const auto from = std::find_if(
      window.zones.begin(), window.zones.end(),
      [&](const LimitZone& zone) { return zone.end > window.start.s + kPlaceRounding; });
  const auto to = std::find_if(from, window.zones.end(), [&](const LimitZone& zone) {
    return zone.begin >= last - kPlaceRounding;
  });
  return {from, to};
}

}  // namespace

void HumpPlanner::advance(Window& window, double horizon, Tail tail) {
  while (!envelope_.plan(zones_until(window, horizon), window.start, {horizon, 0.0})) {
    if (plan_.empty() && window.start.v > 0.0) {
      if (tail == Tail::kOpen) {
        return;  // the window is too short to come to rest in
      }
      ++fallbacks_;
      if (!raise_limits(window, horizon, ramp_)) {
        window.start.v = 0.0;
      }
      continue;
    }
    ++fallbacks_;
    if (window.start.v == 0.0) {
      plan_evenly(window, horizon);
      break;
    }
    commit(plan_.front().b, window);  // a hump of the last plan, which leads to rest at worst
  }
  plan_ = envelope_.humps();
  commit(commit_knot(window, horizon, tail), window);
}

void HumpPlanner::forget(double distance) {
  for (Hump& hump : plan_) {
    hump.a.s -= distance;
    hump.b.s -= distance;
  }
}

/// From rest, under the lowest limit everywhere, a plan always exists.
void HumpPlanner::plan_evenly(const Window& window, double horizon) {
  const auto ahead = zones_until(window, horizon);
  std::vector<LimitZone> even(ahead.begin(), ahead.end());
  double lowest = std::numeric_limits<double>::infinity();
  for (const LimitZone& zone : even) {
    lowest = zone.limit > 0.0 ? std::min(lowest, zone.limit) : lowest;
  }
  for (LimitZone& zone : even) {
    zone.limit = std::min(zone.limit, lowest);
  }
  envelope_.plan(even, window.start, {horizon, 0.0});
}

/// How far a knot may be moved on and still leave room to come down, with no acceleration, to any
/// feedrate below a lower limit before `last`, and to any at all at `last`; negative where it is
/// too far already.
double HumpPlanner::room_after(const Window& window, const Knot& knot, double horizon) const {
  const double longest = longest_descent(knot.v, knot.v, ramp_);
  double room = horizon - knot.s - longest;
  const auto from = std::partition_point(
      window.zones.begin(), window.zones.end(),
      [&](const LimitZone& zone) { return zone.end <= knot.s + kPlaceRounding; });
  for (auto zone = from; zone != window.zones.end() && zone->begin < knot.s + longest + room;
       ++zone) {
    if (zone->limit < knot.v) {
      const double down = longest_descent(knot.v, zone->limit, ramp_);
      room = std::min(room, zone->begin - knot.s - down);
    }
  }
  return room;
}

/// Last place of the plan that its end does not slow down: a knot at its own limit or a hold under
/// a cap. Where there is none, the last peak; where not even that, the start, and the window grows.
Knot HumpPlanner::commit_knot(const Window& window, double horizon, Tail tail) const {
  if (tail == Tail::kClosed) {
    return plan_.back().b;
  }
  Knot peak = window.start;
  for (std::size_t i = plan_.size(); i-- > 0;) {
    const Hump& hump = plan_[i];
    if (hump.b.is_at_limit && room_after(window, hump.b, horizon) >= -kPlaceRounding) {
      return hump.b;
    }
    const double hold = hump.b.s - hump.down - hump.a.s - hump.up;
    const Knot top{hump.a.s + hump.up, hump.peak};
    const double room = room_after(window, top, horizon);
    if (hold > kPlaceRounding && room > kPlaceRounding) {
      return {top.s + std::min(hold, room), top.v};
    }
    if (peak.s == window.start.s && room >= 0.0 && top.s > window.start.s + kPlaceRounding) {
      peak = top;
    }
  }
  return peak;
}

void HumpPlanner::commit(Knot knot, Window& window) {
  std::size_t done = 0;
  for (; done < plan_.size() && plan_[done].b.s <= knot.s + kPlaceRounding; ++done) {
    append_phases(plan_[done], ramp_, window.phases);
  }
  if (done < plan_.size() && knot.s > plan_[done].a.s + kPlaceRounding) {
    Hump first = plan_[done];  // the knot lies at the end of its hold
    first.b = knot;
    first.down = 0.0;
    append_phases(first, ramp_, window.phases);
    plan_[done].a = knot;
    plan_[done].up = 0.0;
  }
  plan_.erase(plan_.begin(), plan_.begin() + static_cast<std::ptrdiff_t>(done));
  window.start = knot;
}

}  // namespace twin::feedrate

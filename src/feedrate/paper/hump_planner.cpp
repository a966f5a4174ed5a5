#include "feedrate/paper/hump_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "feedrate/tolerances.hpp"

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
  commit(commit_anchor(window, horizon, tail), window);
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

/// How far an anchor may be moved on at its feedrate and still leave room to come down [mm]: to any
/// feedrate below each lower limit before the horizon, and to any feedrate at all at the horizon,
/// both without acceleration. It is negative where the anchor is too far on already.
double HumpPlanner::room_after(const Window& window, const Anchor& anchor, double horizon) const {
  const double longest = longest_descent(anchor.v, anchor.v, ramp_);
  double room = horizon - anchor.s - longest;
  const auto from = std::partition_point(
      window.zones.begin(), window.zones.end(),
      [&](const LimitZone& zone) { return zone.end <= anchor.s + kPlaceRounding; });
  for (auto zone = from; zone != window.zones.end() && zone->begin < anchor.s + longest + room;
       ++zone) {
    if (zone->limit < anchor.v) {
      const double down = longest_descent(anchor.v, zone->limit, ramp_);
      room = std::min(room, zone->begin - anchor.s - down);
    }
  }
  return room;
}

/// Last place of the plan that its end does not slow down: an anchor at its own limit, or a hold
/// under a cap. Where the plan has neither, it is the last peak; where it has not even that, it is
/// the start, and the window grows.
Anchor HumpPlanner::commit_anchor(const Window& window, double horizon, Tail tail) const {
  if (tail == Tail::kClosed) {
    return plan_.back().b;
  }
  Anchor peak = window.start;
  for (std::size_t i = plan_.size(); i-- > 0;) {
    const Hump& hump = plan_[i];
    if (hump.b.is_at_limit && room_after(window, hump.b, horizon) >= -kPlaceRounding) {
      return hump.b;
    }
    const double hold = hump.b.s - hump.down - hump.a.s - hump.up;
    const Anchor top{hump.a.s + hump.up, hump.peak};
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

/// Makes the plan final up to an anchor: its phases go to the window, which starts there then.
void HumpPlanner::commit(Anchor anchor, Window& window) {
  std::size_t done = 0;
  for (; done < plan_.size() && plan_[done].b.s <= anchor.s + kPlaceRounding; ++done) {
    append_phases(plan_[done], ramp_, window.phases);
  }
  if (done < plan_.size() && anchor.s > plan_[done].a.s + kPlaceRounding) {
    Hump first = plan_[done];  // the anchor lies at the end of its hold
    first.b = anchor;
    first.down = 0.0;
    append_phases(first, ramp_, window.phases);
    plan_[done].a = anchor;
    plan_[done].up = 0.0;
  }
  plan_.erase(plan_.begin(), plan_.begin() + static_cast<std::ptrdiff_t>(done));
  window.start = anchor;
}

}  // namespace twin::feedrate

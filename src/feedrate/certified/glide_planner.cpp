#include "feedrate/certified/glide_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "feedrate/paper/envelope.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

constexpr double kBrakingDistances = 4.0;     // longest ones, of path between two plans
constexpr std::size_t kMostSegments = 16384;  // of the window; then it is planned to rest
constexpr std::size_t kFewestZones = 1024;    // between two plans for their number

bool is_level(const Phase& phase) { return phase.a == 0.0; }

}  // namespace

bool GlidePlanner::is_due(const Window& window) const {
  return window.length >= due_.length || window.segments.size() >= due_.segments ||
         window.zones.size() >= due_.zones;
}

void GlidePlanner::schedule(const Window& window) {
  const double braking = longest_descent(window.fastest, window.fastest, ramp_);
  due_.length = window.length + kBrakingDistances * braking + corner_reach_;
  due_.segments = std::max(window.segments.size() + look_ahead_, kMostSegments / 4);
  due_.zones = window.zones.size() + std::max(window.zones.size(), kFewestZones);
}

void GlidePlanner::advance(Window& window, double horizon, Tail tail) {
  if (tail == Tail::kOpen && window.segments.size() >= kMostSegments) {
    ++fallbacks_;
    tail = Tail::kClosed;  // the window is full: it is planned to rest
  }
  least_ = ramp_;
  fastest_ = 0.0;
  for (const LimitZone& zone : window.zones) {
    fastest_ = std::max(fastest_, zone.limit);
    least_.acceleration = std::min(least_.acceleration, zone.acceleration);
    least_.jerk = std::min(least_.jerk, zone.jerk);
  }
  while (!plan_until(window, horizon)) {
    if (!fall_back(window, horizon, tail)) {
      return;
    }
  }
  if (tail == Tail::kClosed) {
    commit(window, {plan_.size(), 0.0});
    window.start = {horizon, 0.0};
  } else {
    commit(window, last_final(window, horizon));
  }
}

void GlidePlanner::forget(double distance) {
  for (Phase& phase : plan_) {
    phase.s -= distance;
  }
}

bool GlidePlanner::plan_until(const Window& window, double horizon) {
  const Knot& start = window.start;
  const auto from =
      std::find_if(window.zones.begin(), window.zones.end(),
                   [&](const LimitZone& zone) { return zone.end > start.s + kPlaceRounding; });
  const auto to = std::partition_point(from, window.zones.end(), [&](const LimitZone& zone) {
    return zone.begin < horizon - kPlaceRounding;
  });
  if (!glide_.plan({from, to}, start, {horizon, 0.0}, ramp_)) {
    return false;
  }
  plan_ = glide_.phases();
  return true;
}

/// Makes the next plan possible; false where that needs more of the path.
bool GlidePlanner::fall_back(Window& window, double horizon, Tail tail) {
  if (!plan_.empty()) {
    ++fallbacks_;
    commit(window, next_level());
    return true;
  }
  if (tail == Tail::kOpen) {
    return false;
  }
  ++fallbacks_;
  if (!raise_limits(window, horizon, least_)) {
    window.start.v = 0.0;
  }
  return true;
}

/// Distance of the descent, under the limits before it, to a zone from a feedrate, or more than
/// `most` [mm].
double GlidePlanner::descent_to(const Window& window, std::size_t zone, double v, double most) {
  const LimitZone& valley = window.zones[zone];
  probe_.start(window.zones, zone - 1, {valley.begin, valley.limit}, Sense::kBackward, least_,
               std::max(fastest_, v));
  while (!probe_.is_complete() && probe_.top() < v && probe_.reached() <= most) {
    probe_.extend();
  }
  return probe_.top() < v ? std::numeric_limits<double>::infinity() : probe_.exit_at(v).distance;
}

/// How far a hold may go on and still leave room to come down, with no acceleration, to any valley
/// of the limits before `last`, and to any feedrate at all at `last`; negative where it is too far
/// already.
double GlidePlanner::room_after(const Window& window, const Knot& knot, double horizon) {
  double room = horizon - knot.s - longest_descent(knot.v, knot.v, least_);
  const auto& zones = window.zones;
  const auto from = std::partition_point(zones.begin(), zones.end(), [&](const LimitZone& zone) {
    return zone.end <= knot.s + kPlaceRounding;
  });
  for (auto i = static_cast<std::size_t>(from - zones.begin());
       room >= 0.0 && i < zones.size() && zones[i].begin < horizon; ++i) {
    const bool is_valley = i + 1 == zones.size() || zones[i + 1].limit > zones[i].limit;
    if (is_valley && zones[i].limit < knot.v) {
      const double most = zones[i].begin - knot.s;
      room = std::min(room, most - descent_to(window, i, knot.v, most));
    }
  }
  return room;
}

GlidePlanner::Cut GlidePlanner::last_final(const Window& window, double horizon) {
  const Glide::Part& part = glide_.parts().back();
  for (std::size_t i = part.descent + 1; i-- > part.first;) {
    if (i >= plan_.size() || !is_level(plan_[i])) {
      continue;
    }
    const Phase& phase = plan_[i];
    const double room = room_after(window, {phase.s, phase.v}, horizon);
    if (room < -kPlaceRounding) {
      continue;
    }
    const bool is_hold = phase.j == 0.0 && phase.v > 0.0 && i < part.descent;
    return {i, is_hold ? std::min(phase.duration, std::max(room, 0.0) / phase.v) : 0.0};
  }
  // The last knot is too close to the window's end: one summit back it is not.
  return {glide_.parts().size() > 1 ? std::prev(glide_.parts().end(), 2)->first : 0, 0.0};
}

/// The next place without acceleration of the last plan.
GlidePlanner::Cut GlidePlanner::next_level() const {
  std::size_t i = 1;
  while (i < plan_.size() && !is_level(plan_[i])) {
    ++i;
  }
  return {i, 0.0};
}

void GlidePlanner::commit(Window& window, const Cut& cut) {
  const auto done = plan_.begin() + static_cast<std::ptrdiff_t>(cut.phase);
  window.phases.insert(window.phases.end(), plan_.begin(), done);
  if (done != plan_.end()) {
    window.start = {done->s, done->v};
    if (cut.time > 0.0) {
      window.phases.push_back(*done);
      window.phases.back().duration = cut.time;
      *done = remainder_after(*done, cut.time);
      window.start = {done->s, done->v};
    }
  } else if (!plan_.empty()) {
    window.start = {motion_at(plan_.back(), plan_.back().duration).s, 0.0};
  }
  plan_.erase(plan_.begin(), done);
}

}  // namespace twin::feedrate

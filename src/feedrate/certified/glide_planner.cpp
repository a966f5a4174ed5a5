#include "feedrate/certified/glide_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Path between two plans, in longest braking distances. It trades work for delay: what a plan does
/// not make final is planned again, so each zone is planned about 1.5 times. Twice as many bring
/// that nearer to once, and the first segment waits twice as long.
constexpr double kBrakingDistances = 4.0;

/// Segments in the window at which it is planned to rest, though more follow. It bounds memory and
/// the time of one plan. Twice as many double both, and a path of segments half as long goes
/// through without a stop.
constexpr std::size_t kMostSegments = 16384;

/// Fewest zones between two plans where their number makes a plan due. It keeps a path of many
/// zones from waiting for its braking distances; twice as many double that wait and the window.
constexpr std::size_t kFewestZones = 1024;

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
  while (!plan_until(window.zones, window.start, horizon)) {  // each turn takes a way out less
    if (window.start.v == 0.0 && plan_.empty()) {
      plan_evenly(window, horizon);
      break;
    }
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
  for (Glide::LegEnd& leg : legs_) {
    leg.s -= distance;
  }
}

bool GlidePlanner::plan_until(std::span<const LimitZone> zones, const Anchor& start,
                              double horizon) {
  const auto from = std::find_if(zones.begin(), zones.end(), [&](const LimitZone& zone) {
    return zone.end > start.s + kPlaceRounding;
  });
  const auto to = std::partition_point(from, zones.end(), [&](const LimitZone& zone) {
    return zone.begin < horizon - kPlaceRounding;
  });
  if (!glide_.plan({from, to}, start, {horizon, 0.0}, ramp_)) {
    return false;
  }
  plan_ = glide_.phases();
  legs_ = glide_.legs();
  return true;
}

/// From rest, with the lowest limits of all zones everywhere, a plan always exists.
void GlidePlanner::plan_evenly(const Window& window, double horizon) {
  ++fallbacks_;
  std::vector<LimitZone> even(window.zones);
  double lowest = std::numeric_limits<double>::infinity();
  for (const LimitZone& zone : even) {
    lowest = zone.limit > 0.0 ? std::min(lowest, zone.limit) : lowest;
  }
  for (LimitZone& zone : even) {
    zone = {zone.begin, zone.end, std::min(zone.limit, lowest), least_.acceleration, least_.jerk};
  }
  [[maybe_unused]] const bool is_planned = plan_until(even, window.start, horizon);
  assert(is_planned);
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

/// Distance that the descent from a feedrate to a zone takes under the limits before it [mm]; any
/// larger number where it takes more than `most`.
double GlidePlanner::descent_to(const Window& window, std::size_t zone, double v, double most) {
  const LimitZone& valley = window.zones[zone];
  probe_.start(window.zones, zone - 1, {valley.begin, valley.limit}, Sense::kBackward, least_,
               std::max(fastest_, v));
  while (!probe_.is_complete() && probe_.top() < v && probe_.reached() <= most) {
    probe_.extend();
  }
  return probe_.top() < v ? std::numeric_limits<double>::infinity() : probe_.exit_at(v).distance;
}

/// How far a hold may go on and still leave room to come down [mm]: to each valley of the limits
/// before the horizon, and to any feedrate at all at the horizon, both without acceleration. It is
/// negative where the hold is too far on already.
double GlidePlanner::room_after(const Window& window, const Anchor& anchor, double horizon) {
  double room = horizon - anchor.s - longest_descent(anchor.v, anchor.v, least_);
  const auto& zones = window.zones;
  const auto from = std::partition_point(zones.begin(), zones.end(), [&](const LimitZone& zone) {
    return zone.end <= anchor.s + kPlaceRounding;
  });
  for (auto i = static_cast<std::size_t>(from - zones.begin());
       room >= 0.0 && i < zones.size() && zones[i].begin < horizon; ++i) {
    const bool is_valley = i + 1 == zones.size() || zones[i + 1].limit > zones[i].limit;
    if (is_valley && zones[i].limit < anchor.v) {
      const double most = zones[i].begin - anchor.s;
      room = std::min(room, most - descent_to(window, i, anchor.v, most));
    }
  }
  return room;
}

/// The last place of the plan that no segment to come can change.
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
  // The last anchor is too close to the window's end: one summit back it is not.
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

/// Makes the plan final up to a place: its phases go to the window, which starts there then.
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
  if (ramps_ == Ramps::kOfZones) {
    commit_stretches(window);
  }
}

/// Hands on the legs up to the window's start, for stops.
void GlidePlanner::commit_stretches(Window& window) {
  const Anchor& start = window.start;
  std::size_t done = 0;
  for (; done < legs_.size() && legs_[done].s <= start.s + kPlaceRounding; ++done) {
    const Glide::LegEnd& leg = legs_[done];
    window.stretches.push_back({.end = leg.s,
                                .ramp = leg.ramp,
                                .is_harder_after = is_harder_after(done, start.s),
                                .rest = rest_after(done + 1, {leg.s, leg.v, 0.0})});
  }
  legs_.erase(legs_.begin(), legs_.begin() + static_cast<std::ptrdiff_t>(done));
  const double last = window.stretches.empty() ? 0.0 : window.stretches.back().end;
  if (!legs_.empty() && start.s > last + kPlaceRounding) {
    window.stretches.push_back({.end = start.s,
                                .ramp = legs_.front().ramp,
                                .is_harder_after = false,
                                .rest = rest_after(0, {start.s, start.v, 0.0})});
  }
}

/// Whether a stop may take the deceleration of a leg on to the next one: that one allows it, and is
/// long enough for it to be lost up to its end, or up to where it is final.
bool GlidePlanner::is_harder_after(std::size_t leg, double last) const {
  if (leg + 1 >= legs_.size()) {
    return false;
  }
  const Glide::LegEnd& here = legs_[leg];
  const Glide::LegEnd& next = legs_[leg + 1];
  return next.ramp.acceleration >= here.ramp.acceleration && next.ramp.jerk >= here.ramp.jerk &&
         std::min(next.s, last) - here.s >= here.v * here.ramp.acceleration / next.ramp.jerk;
}

/// Where a stop rests that begins on a leg without acceleration [mm].
double GlidePlanner::rest_after(std::size_t leg, PathMotion from) const {
  for (; leg < legs_.size(); ++leg) {
    const StopPart part =
        make_stop_part(from, {.end = legs_[leg].s,
                              .ramp = legs_[leg].ramp,
                              .is_harder_after = is_harder_after(leg, legs_.back().s)});
    from = end_of(part.brake);
    if (part.rests) {
      break;
    }
  }
  return from.s;
}

}  // namespace twin::feedrate

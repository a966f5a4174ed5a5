#include "feedrate/certified/glide_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
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

/// Whether a zone is a single place that limits the jerk beside it.
bool is_calm_place(const LimitZone& zone) {
  return zone.begin == zone.end && std::isfinite(zone.jerk);
}

bool has_calm_places(std::span<const LimitZone> zones) {
  return std::any_of(zones.begin(), zones.end(), is_calm_place);
}

/// Zones with the jerk of such places within a distance of them.
std::vector<LimitZone> calmed(std::span<const LimitZone> zones, double reach) {
  std::vector<LimitZone> places;
  std::copy_if(zones.begin(), zones.end(), std::back_inserter(places), is_calm_place);
  std::vector<LimitZone> result;
  std::size_t first = 0;  // place that still reaches beyond the zone's begin
  for (LimitZone zone : zones) {
    const double end = zone.end;
    while (first < places.size() && places[first].begin + reach <= zone.begin) {
      ++first;
    }
    for (double begin = zone.begin; begin < end; begin = zone.end) {
      LimitZone part = zone;
      part.begin = begin;
      part.end = end;
      for (std::size_t i = first; i < places.size() && places[i].begin - reach < end; ++i) {
        const double from = places[i].begin - reach;
        const double to = places[i].begin + reach;
        if (from > begin + kPlaceRounding) {
          part.end = std::min(part.end, from);
        } else if (to > begin + kPlaceRounding) {
          part.end = std::min(part.end, to);
          part.jerk = std::min(part.jerk, places[i].jerk);
        }
      }
      result.push_back(part);
      zone.end = part.end;
    }
    if (zone.begin == end) {
      result.push_back(zone);
    }
  }
  return result;
}

}  // namespace

bool GlidePlanner::is_due(const Window& window) const {
  return window.length >= due_.length || window.segments.size() >= due_.segments ||
         window.zones.size() >= due_.zones;
}

void GlidePlanner::schedule(const Window& window) {
  double braking = longest_descent(window.fastest, window.fastest, ramp_);
  double passage = 0.0;  // longest one, which is no place to brake
  for (const LimitZone& zone : window.zones) {
    passage = is_passage(zone) ? std::max(passage, zone.end - zone.begin) : passage;
  }
  braking += passage;
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
    least_.acceleration = std::min({least_.acceleration, zone.acceleration, zone.deceleration});
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
  pieces_.forget(distance);
}

bool GlidePlanner::plan_until(std::span<const LimitZone> zones, const Anchor& start,
                              double horizon) {
  const auto from = std::find_if(zones.begin(), zones.end(), [&](const LimitZone& zone) {
    return zone.end > start.s + kPlaceRounding;
  });
  const auto to = std::partition_point(from, zones.end(), [&](const LimitZone& zone) {
    return zone.begin < horizon - kPlaceRounding;
  });
  std::span<const LimitZone> planned(from, to);
  if (has_calm_places(planned)) {
    calmed_ = calmed(planned, corner_reach_);
    planned = calmed_;
  }
  if (!glide_.plan(planned, start, {horizon, 0.0}, ramp_)) {
    return false;
  }
  plan_ = glide_.phases();
  fallbacks_ += glide_.is_even() ? 1 : 0;
  if (ramps_ == Ramps::kOfZones) {
    pieces_.find(plan_, glide_.leg_ends(), planned, ramp_);
  }
  return true;
}

/// From rest, with the lowest limits of all zones everywhere, a plan always exists.
void GlidePlanner::plan_evenly(const Window& window, double horizon) {
  ++fallbacks_;
  std::vector<LimitZone> even(window.zones);
  double lowest = std::numeric_limits<double>::infinity();
  for (const LimitZone& zone : even) {
    lowest = zone.limit > 0.0 ? std::min({lowest, zone.limit, zone.held_above}) : lowest;
  }
  for (LimitZone& zone : even) {
    zone = {zone.begin,          zone.end,   std::min(zone.limit, lowest), least_.acceleration,
            least_.acceleration, least_.jerk};
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
  const auto probe = [&](auto& rise) {
    rise.start(window.zones, zone - 1, {valley.begin, valley.limit}, Sense::kBackward, ramp_,
               std::max(fastest_, v));
    while (!rise.is_complete() && rise.top() < v && rise.reached() <= most) {
      rise.extend();
    }
    return rise.top() < v ? std::numeric_limits<double>::infinity() : rise.exit_at(v).distance;
  };
  return ramps_ == Ramps::kOfZones ? probe(zone_probe_) : probe(probe_);
}

/// Distance before the horizon within which a feedrate can be lowered to any other [mm]. Of the zones
/// before the horizon as many count as that takes.
double GlidePlanner::descent_at(const Window& window, double horizon, double v) const {
  RampLimits least = ramp_;
  double distance = longest_descent(v, v, least);
  for (std::size_t i = window.zones.size(); ramps_ == Ramps::kOfZones && i-- > 0;) {
    const LimitZone& zone = window.zones[i];
    if (zone.end <= horizon - distance) {
      break;
    }
    if (is_passage(zone) && zone.begin >= horizon - kPlaceRounding) {
      continue;
    }
    least.acceleration = std::min(least.acceleration, zone.deceleration);
    least.jerk = std::min(least.jerk, zone.jerk);
    distance = longest_descent(v, v, least);
  }
  return distance;
}

/// How far a hold may go on and still leave room to come down [mm]: to each valley of the limits
/// before the horizon, and to any feedrate at all at the horizon, both without acceleration. It is
/// negative where the hold is too far on already.
double GlidePlanner::room_after(const Window& window, const Anchor& anchor, double horizon) {
  double room = horizon - anchor.s - descent_at(window, horizon, anchor.v);
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
  const std::size_t last = glide_.last_free_part();
  const Glide::Part& part = glide_.parts()[last];
  horizon = std::min(horizon, glide_.free_end());
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
  return {std::max(last > 0 ? glide_.parts()[last - 1].first : 0, glide_.first_after_passage()),
          0.0};
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
    pieces_.commit(window.start, window.stretches);
  }
}

}  // namespace twin::feedrate

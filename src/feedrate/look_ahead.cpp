#include "feedrate/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feedrate/corner_limit.hpp"
#include "feedrate/segment_limits.hpp"

namespace twin::feedrate {
namespace {

constexpr double kPlaceRounding = 1e-9;  // [mm]

}  // namespace

LookAhead::LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                     double period, Sink sink, Start start, double override_scale)
    : limits_(limits),
      rules_(limits, model, path, period),
      look_ahead_(static_cast<std::size_t>(std::max(path.look_ahead, 2))),
      period_(period),
      sink_(std::move(sink)),
      start_of_plan_(start),
      override_scale_(override_scale),
      ramp_{limits.acceleration, limits.jerk, model.acceleration_profile},
      envelope_(ramp_),
      junctions_(limits, model, period),
      start_{start.s, start.v} {}

void LookAhead::push(path::Segment&& segment) {
  if (!window_.empty()) {
    junctions_.append(window_.back(), segment, length_, zones_);
  }
  append_limits(segment);
  length_ += segment.length;
  window_.push_back(std::move(segment));
  if (window_.size() >= look_ahead_) {
    plan(false);
  }
}

double LookAhead::asked_feedrate(const path::Segment& segment) const {
  if (override_scale_ == 1.0) {
    return segment.feedrate;
  }
  const double scale = segment.is_rapid ? std::min(override_scale_, 1.0) : override_scale_;
  return std::min(scale * segment.feedrate, std::max(limits_.feedrate, segment.feedrate));
}

/// Appends the limits of a segment at the window's end. As far as the way from the start's feedrate
/// down to the one asked for goes, the start's feedrate is asked for.
void LookAhead::append_limits(const path::Segment& segment) {
  const double asked = asked_feedrate(segment);
  const double down =
      asked < start_of_plan_.v
          ? start_of_plan_.s + ramp_distance(start_of_plan_.v, asked, ramp_) - length_
          : 0.0;
  if (down > 0.0 && segment.length > 0.0) {
    const double border = length_ + std::min(down, segment.length);
    const std::size_t first = zones_.size();
    append_segment_limits(segment, length_, start_of_plan_.v, rules_, zones_);
    std::erase_if(zones_, [&](const LimitZone& zone) { return zone.begin >= border; });
    asked_.clear();
    append_segment_limits(segment, length_, asked, rules_, asked_);
    if (zones_.size() > first) {
      zones_.back().end = std::min(zones_.back().end, border);
    }
    for (LimitZone zone : asked_) {
      if (zone.end > border) {
        zone.begin = std::max(zone.begin, border);
        zones_.push_back(zone);
      }
    }
    return;
  }
  append_segment_limits(segment, length_, asked, rules_, zones_);
}

void LookAhead::finish() {
  if (!window_.empty()) {
    plan(true);
  }
}

/// Where a plan ends at rest: up to there no later corner lowers a limit any more.
double LookAhead::horizon(bool is_last) const {
  return is_last ? length_ : length_ - kHidingPeriods * limits_.feedrate * period_;
}

void LookAhead::plan(bool is_last) {
  const double last = horizon(is_last);
  if (last <= start_.s + kPlaceRounding && !is_last) {
    return;
  }
  while (!envelope_.plan(zones_until(last), start_, {last, 0.0})) {
    if (plan_.empty() && start_.v > 0.0) {
      if (!is_last) {
        return;  // the window is too short to come to rest in
      }
      ++fallbacks_;
      if (!raise_limits(last)) {
        start_.v = 0.0;
      }
      continue;
    }
    ++fallbacks_;
    if (start_.v == 0.0) {
      plan_evenly(last);
      break;
    }
    commit(plan_.front().b);  // a hump of the last plan, which leads to rest at worst
  }
  plan_ = envelope_.humps();
  commit(commit_knot(last, is_last));
  emit_covered(is_last);
}

/// Zones between the start and a place.
std::span<const LimitZone> LookAhead::zones_until(double last) const {
  const auto from = std::find_if(zones_.begin(), zones_.end(), [&](const LimitZone& zone) {
    return zone.end > start_.s + kPlaceRounding;
  });
  const auto to = std::find_if(from, zones_.end(), [&](const LimitZone& zone) {
    return zone.begin >= last - kPlaceRounding;
  });
  return {from, to};
}

/// From rest, under the lowest limit everywhere, a plan always exists.
void LookAhead::plan_evenly(double last) {
  const auto ahead = zones_until(last);
  std::vector<LimitZone> even(ahead.begin(), ahead.end());
  double lowest = limits_.feedrate;
  for (const LimitZone& zone : even) {
    lowest = zone.limit > 0.0 ? std::min(lowest, zone.limit) : lowest;
  }
  for (LimitZone& zone : even) {
    zone.limit = std::min(zone.limit, lowest);
  }
  envelope_.plan(even, start_, {last, 0.0});
}

/// Raises the limits so far that a start which is too fast for them can come down; false where
/// they have been raised already.
bool LookAhead::raise_limits(double last) {
  bool is_raised = false;
  const double from = start_.s + kPlaceRounding;
  const double to = std::min(last, start_.s + longest_descent(start_.v, start_.v, ramp_));
  for (LimitZone& zone : zones_) {
    if (zone.end > from && zone.begin < to && zone.limit > 0.0 && zone.limit < start_.v) {
      zone.limit = start_.v;
      is_raised = true;
    }
  }
  return is_raised;
}

/// How far a knot may be moved on and still leave room to come down, with no acceleration, to any
/// feedrate below a lower limit before `last`, and to any at all at `last`; negative where it is
/// too far already.
double LookAhead::room_after(const Knot& knot, double last) const {
  const double longest = longest_descent(knot.v, knot.v, ramp_);
  double room = last - knot.s - longest;
  const auto from = std::partition_point(zones_.begin(), zones_.end(), [&](const LimitZone& zone) {
    return zone.end <= knot.s + kPlaceRounding;
  });
  for (auto zone = from; zone != zones_.end() && zone->begin < knot.s + longest + room; ++zone) {
    if (zone->limit < knot.v) {
      const double down = longest_descent(knot.v, zone->limit, ramp_);
      room = std::min(room, zone->begin - knot.s - down);
    }
  }
  return room;
}

/// Last place of the plan that its end does not slow down: a knot at its own limit or a hold under
/// a cap. Where there is none, the last peak; where not even that, the start, and the window grows.
Knot LookAhead::commit_knot(double last, bool is_last) const {
  if (is_last) {
    return plan_.back().b;
  }
  Knot peak = start_;
  for (std::size_t i = plan_.size(); i-- > 0;) {
    const Hump& hump = plan_[i];
    if (hump.b.is_at_limit && room_after(hump.b, last) >= -kPlaceRounding) {
      return hump.b;
    }
    const double hold = hump.b.s - hump.down - hump.a.s - hump.up;
    const Knot top{hump.a.s + hump.up, hump.peak};
    const double room = room_after(top, last);
    if (hold > kPlaceRounding && room > kPlaceRounding) {
      return {top.s + std::min(hold, room), top.v};
    }
    if (peak.s == start_.s && room >= 0.0 && top.s > start_.s + kPlaceRounding) {
      peak = top;
    }
  }
  return peak;
}

void LookAhead::commit(Knot knot) {
  std::size_t done = 0;
  for (; done < plan_.size() && plan_[done].b.s <= knot.s + kPlaceRounding; ++done) {
    append_phases(plan_[done], ramp_, phases_);
  }
  if (done < plan_.size() && knot.s > plan_[done].a.s + kPlaceRounding) {
    Hump first = plan_[done];  // the knot lies at the end of its hold
    first.b = knot;
    first.down = 0.0;
    append_phases(first, ramp_, phases_);
    plan_[done].a = knot;
    plan_[done].up = 0.0;
  }
  plan_.erase(plan_.begin(), plan_.begin() + static_cast<std::ptrdiff_t>(done));
  start_ = knot;
}

void LookAhead::emit_covered(bool is_last) {
  double begin = 0.0;
  std::size_t next_phase = 0;
  std::size_t next_zone = 0;
  while (!window_.empty() &&
         (is_last || begin + window_.front().length <= start_.s - kPlaceRounding)) {
    PlannedSegment planned;
    planned.segment = std::move(window_.front());
    planned.index = next_index_++;
    window_.pop_front();
    const double end = begin + planned.segment.length;
    take_phases(begin, end, next_phase, planned);
    for (; next_zone < zones_.size() && zones_[next_zone].end <= end + kPlaceRounding;
         ++next_zone) {
      const LimitZone& zone = zones_[next_zone];
      planned.limits.push_back({zone.begin - begin, zone.end - begin, zone.limit});
    }
    begin = end;
    sink_(std::move(planned));
  }
  forget(begin, next_phase, next_zone);
}

void LookAhead::take_phases(double begin, double end, std::size_t& next, PlannedSegment& planned) {
  if (planned.segment.length == 0.0) {
    planned.phases.push_back({planned.segment.dwell, 0.0, 0.0, 0.0, 0.0});
    return;
  }
  for (; next < phases_.size(); ++next) {
    Phase phase = phases_[next];
    if (phase.s > end + kPlaceRounding) {
      break;  // the plan starts in a later segment
    }
    const bool crosses = motion_at(phase, phase.duration).s > end + kPlaceRounding;
    if (crosses) {
      const double t = time_at(phase, end);
      phases_[next] = remainder_after(phase, t);
      phases_[next].s = end;
      phase.duration = t;
    }
    phase.s -= begin;
    planned.phases.push_back(phase);
    if (crosses) {
      break;
    }
  }
}

/// Drops what was handed on and measures everything from the new window's start.
void LookAhead::forget(double begin, std::size_t phases, std::size_t zones) {
  phases_.erase(phases_.begin(), phases_.begin() + static_cast<std::ptrdiff_t>(phases));
  zones_.erase(zones_.begin(), zones_.begin() + static_cast<std::ptrdiff_t>(zones));
  for (Phase& phase : phases_) {
    phase.s -= begin;
  }
  for (LimitZone& zone : zones_) {
    zone.begin -= begin;
    zone.end -= begin;
  }
  junctions_.forget(begin, zones);
  for (Hump& hump : plan_) {
    hump.a.s -= begin;
    hump.b.s -= begin;
  }
  start_.s -= begin;
  start_of_plan_.s -= begin;
  length_ -= begin;
}

}  // namespace twin::feedrate

#include "feedrate/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feedrate/segment_limits.hpp"

namespace twin::feedrate {
namespace {

constexpr double kPlaceRounding = 1e-9;  // [mm]

}  // namespace

LookAhead::LookAhead(const Limits& limits, const PlanningModel& model, int look_ahead,
                     double period, Sink sink)
    : limits_(limits),
      model_(model),
      look_ahead_(static_cast<std::size_t>(std::max(look_ahead, 2))),
      period_(period),
      sink_(std::move(sink)),
      ramp_{limits.acceleration, limits.jerk},
      envelope_(ramp_),
      junctions_(limits, model, period) {}

void LookAhead::push(path::Segment&& segment) {
  if (!window_.empty()) {
    junctions_.append(window_.back(), segment, length_, zones_);
  }
  append_segment_limits(segment, length_, model_, limits_, zones_);
  length_ += segment.length;
  window_.push_back(std::move(segment));
  if (window_.size() >= look_ahead_) {
    plan(false);
  }
}

void LookAhead::finish() {
  if (!window_.empty()) {
    plan(true);
  }
}

void LookAhead::plan(bool is_last) {
  while (!plan_window()) {
    ++fallbacks_;
    commit(plan_.front().b);  // the last plan stands: one hump further along it
  }
  commit(commit_knot(is_last));
  emit_covered(is_last);
}

/// Plans from start_ to rest at the window's end. From rest that always succeeds, if need be under
/// the lowest limit.
bool LookAhead::plan_window() {
  const auto from = std::find_if(zones_.begin(), zones_.end(), [&](const LimitZone& zone) {
    return zone.end > start_.s + kPlaceRounding;
  });
  std::vector<LimitZone> ahead(from, zones_.end());
  const Knot end{length_, 0.0};
  if (!envelope_.plan(ahead, start_, end)) {
    if (start_.v > 0.0) {
      return false;
    }
    double lowest = limits_.feedrate;
    for (const LimitZone& zone : ahead) {
      lowest = zone.limit > 0.0 ? std::min(lowest, zone.limit) : lowest;
    }
    for (LimitZone& zone : ahead) {
      zone.limit = std::min(zone.limit, lowest);
    }
    ++fallbacks_;
    envelope_.plan(ahead, start_, end);
  }
  plan_ = envelope_.humps();
  return true;
}

/// Last place of the plan that the window's end does not slow down: a hold, as long as any lower
/// limit known by then can still be braked for, or a knot at its own limit after which the feedrate
/// rises. Where there is none, the last peak; where not even that, the start, and the window grows.
Knot LookAhead::commit_knot(bool is_last) const {
  if (is_last) {
    return plan_.back().b;
  }
  const double latest = length_ - 4.0 * limits_.feedrate * period_;
  Knot best = start_;
  Knot peak = start_;
  for (std::size_t i = 0; i < plan_.size(); ++i) {
    const Hump& hump = plan_[i];
    const double hold_begin = hump.a.s + hump.up;
    const double braking =
        ramp_distance(hump.peak, hump.peak / 3.0, ramp_);  // the longest from there
    const double hold_end = std::min(hump.b.s - hump.down - braking, latest);
    if (hold_end - hold_begin > kPlaceRounding) {
      best = {hold_end, hump.peak};
    } else if (hold_begin <= latest) {
      peak = {hold_begin, hump.peak};
    }
    if (hump.b.is_at_limit && hump.b.s <= latest && i + 1 < plan_.size() && plan_[i + 1].up > 0.0) {
      best = hump.b;
    }
  }
  return best.s > start_.s + kPlaceRounding ? best : peak;
}

void LookAhead::commit(const Knot& knot) {
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
  length_ -= begin;
}

}  // namespace twin::feedrate

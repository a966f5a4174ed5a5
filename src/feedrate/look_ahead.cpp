#include "feedrate/look_ahead.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "feedrate/corner_limit.hpp"
#include "feedrate/segment_limits.hpp"

namespace twin::feedrate {
namespace {

constexpr double kPlaceRounding = 1e-9;  // [mm]
constexpr double kStraight = 1e-7;       // turn that is none [rad]

double turn_between(const Vec3& before, const Vec3& after) {
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

}  // namespace

LookAhead::LookAhead(const Limits& limits, const PlanningModel& model, int look_ahead,
                     double period, Sink sink)
    : limits_(limits),
      model_(model),
      look_ahead_(static_cast<std::size_t>(std::max(look_ahead, 2))),
      period_(period),
      sink_(std::move(sink)),
      ramp_{limits.acceleration, limits.jerk},
      envelope_(ramp_) {}

void LookAhead::push(path::Segment&& segment) {
  if (!window_.empty()) {
    append_junction(window_.back(), segment);
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

void LookAhead::append_junction(const path::Segment& before, const path::Segment& after) {
  if (before.stops_at_end || after.length == 0.0) {
    zones_.push_back({length_, length_, 0.0});
    turns_.clear();
    return;
  }
  const double turn = turn_between(before.end.tangent, after.begin.tangent);
  if (turn < kStraight) {
    return;
  }
  const double reach = limits_.feedrate * period_;
  const double curvature =
      std::max(curvature_near_end(before, true, reach), curvature_near_end(after, false, reach));
  const double corner_error = std::min(before.corner_error, after.corner_error);
  double limit =
      std::min(corner_model_feedrate(turn, corner_error, model_),
               corner_acceleration_feedrate(turn, curvature, limits_.acceleration, period_));
  if (turn < kSharpTurn && curvature > 0.0) {
    limit = std::min(limit, std::max(kHidingShare * turn / (curvature * period_),
                                     corner_ripple_feedrate(turn, limits_.jerk, period_)));
  }
  zones_.push_back({length_, length_, limit});
  limit_cluster(turn, length_);
}

/// Corners a few periods apart limit each other. Where the turns of several corners, over the
/// distance l from the first to the last, sum to phi, the feedrate either keeps them apart (v T <=
/// l) or obeys the corner rule for phi. And where one hides the other from the set points, it
/// either puts kHidingPeriods between them or keeps the ripple small.
void LookAhead::limit_cluster(double turn, double s) {
  LimitZone& latest = zones_.back();
  const auto lower = [](LimitZone& zone, double limit) {
    zone.limit = std::min(zone.limit, limit);
  };
  double sum = turn;
  for (auto old = turns_.rbegin(); old != turns_.rend(); ++old) {
    const double apart = (s - old->s) / period_;
    if (apart >= kHidingPeriods * latest.limit) {
      break;
    }
    sum += old->angle;
    LimitZone& zone = zones_[old->zone];
    const double together = corner_acceleration_feedrate(std::min(sum, std::numbers::pi), 0.0,
                                                         limits_.acceleration, period_);
    lower(latest, std::max(apart, together));
    lower(zone, std::max(apart, together));
    const auto limit_hidden = [&](double hidden, double hiding, LimitZone& place) {
      if (hidden < kSharpTurn && hiding > kHidingShare * hidden) {
        lower(place, std::max(apart / kHidingPeriods,
                              corner_ripple_feedrate(hidden, limits_.jerk, period_)));
      }
    };
    limit_hidden(turn, old->angle, latest);
    limit_hidden(old->angle, turn, zone);
  }
  const double forget = s - kHidingPeriods * limits_.feedrate * period_;
  std::erase_if(turns_, [&](const Turn& old) { return old.s < forget; });
  turns_.push_back({s, turn, zones_.size() - 1});
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
  const auto to = std::find_if(zones_.rbegin(), zones_.rend(), [&](const LimitZone& zone) {
                    return zone.begin < last - kPlaceRounding;
                  }).base();
  const auto next = [&] {
    return std::find_if(zones_.begin(), to, [&](const LimitZone& zone) {
      return zone.end > start_.s + kPlaceRounding;
    });
  };
  while (!envelope_.plan({next(), to}, start_, {last, 0.0})) {
    ++fallbacks_;
    if (plan_.empty()) {
      return;
    }
    commit(plan_.front().b);  // a hump of the last plan, which leads to rest at worst
  }
  plan_ = envelope_.humps();
  commit(commit_knot(last, is_last));
  emit_covered(is_last);
}

/// How far a knot may be moved on and still leave room to come down, with no acceleration, to any
/// feedrate below a lower limit before `last`, and to any at all at `last`; negative where it is
/// too far already.
///
/// Of all ramps down from v the longest is not the one to rest: (v + w)/2 tau(v - w) is greatest at
///   w = v / 3         where A is not reached, 2 v / 3 <= A^2 / J,
///   w = A^2 / (2 J)   else.
double LookAhead::room_after(const Knot& knot, double last) const {
  const double worst =
      std::min(knot.v / 3.0, 0.5 * ramp_.acceleration * ramp_.acceleration / ramp_.jerk);
  const double longest = ramp_distance(knot.v, worst, ramp_);
  double room = last - knot.s - longest;
  const auto from = std::partition_point(zones_.begin(), zones_.end(), [&](const LimitZone& zone) {
    return zone.end <= knot.s + kPlaceRounding;
  });
  for (auto zone = from; zone != zones_.end() && zone->begin < knot.s + longest + room; ++zone) {
    if (zone->limit < knot.v) {
      const double down = ramp_distance(knot.v, std::min(zone->limit, worst), ramp_);
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
  for (auto hump = plan_.rbegin(); hump != plan_.rend(); ++hump) {
    if (hump->b.is_at_limit && room_after(hump->b, last) >= -kPlaceRounding) {
      return hump->b;
    }
    const double hold = hump->b.s - hump->down - hump->a.s - hump->up;
    const Knot top{hump->a.s + hump->up, hump->peak};
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
  std::erase_if(turns_, [&](const Turn& turn) { return turn.zone < zones; });
  for (Turn& turn : turns_) {
    turn.s -= begin;
    turn.zone -= zones;
  }
  for (Hump& hump : plan_) {
    hump.a.s -= begin;
    hump.b.s -= begin;
  }
  start_.s -= begin;
  length_ -= begin;
}

}  // namespace twin::feedrate

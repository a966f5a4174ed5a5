#include "feedrate/look_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feedrate/certified/glide_planner.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "feedrate/limits/corner_limit.hpp"
#include "feedrate/limits/segment_limits.hpp"
#include "feedrate/paper/hump_planner.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

constexpr double kBrakingDistances = 4.0;  // longest ones, of path between two plans
constexpr double kRest = 0.25;  // of an axis's limits, beside what the feedrate takes of them
constexpr std::size_t kMostSegments = 16384;  // of the window; then it is planned to rest
constexpr std::size_t kFewestZones = 1024;    // between two plans for their number

/// A zone within [begin, end], measured from begin.
LimitZone part_of(LimitZone zone, double begin, double end) {
  zone.begin = zone.begin < begin - kPlaceRounding ? 0.0 : zone.begin - begin;
  zone.end = (zone.end > end + kPlaceRounding ? end : zone.end) - begin;
  return zone;
}

}  // namespace

LookAhead::LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                     double period, Sink sink, Start start, double override_scale)
    : limits_(limits),
      rules_(limits, model, path, period),
      certified_limits_(limits, model, path, period),
      has_axis_limits_(has_axis_limits(limits)),
      is_certified_(is_certified(path, model)),
      look_ahead_(static_cast<std::size_t>(std::max(path.look_ahead, 2))),
      period_(period),
      sink_(std::move(sink)),
      start_of_plan_(start),
      override_scale_(override_scale),
      ramp_{limits.acceleration, limits.jerk, model.acceleration_profile},
      junctions_(limits, model, period) {
  work_.start = {start.s, start.v};
  if (is_certified_) {
    planner_ = std::make_unique<GlidePlanner>(ramp_);
  } else {
    planner_ = std::make_unique<HumpPlanner>(ramp_);
  }
}

void LookAhead::push(path::Segment&& segment) {
  if (!window_.empty()) {
    junctions_.append(window_.back(), segment, length_, work_.zones);
  }
  take_limits(segment);
  length_ += segment.length;
  fastest_ = std::max(fastest_, asked_feedrate(segment));
  window_.push_back(std::move(segment));
  if (is_due()) {
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

/// A and J that are left on any part of the path where axes have limits of their own.
RampLimits LookAhead::start_ramp() const {
  RampLimits least = ramp_;
  for (int i = 0; has_axis_limits_ && is_certified_ && i < 3; ++i) {
    if (limits_.axis_acceleration[i] > 0.0) {
      least.acceleration = std::min(least.acceleration, kRest * limits_.axis_acceleration[i]);
    }
    if (limits_.axis_jerk[i] > 0.0) {
      least.jerk = std::min(least.jerk, kRest * limits_.axis_jerk[i]);
    }
  }
  return least;
}

/// Appends the limits of a segment at the window's end. As far as the way from the start's feedrate
/// down to the one asked for goes, the start's feedrate is asked for.
void LookAhead::take_limits(const path::Segment& segment) {
  const double asked = asked_feedrate(segment);
  const std::size_t first = work_.zones.size();
  const double down =
      asked < start_of_plan_.v
          ? start_of_plan_.s + ramp_distance(start_of_plan_.v, asked, start_ramp()) - length_
          : 0.0;
  if (down > 0.0 && segment.length > 0.0) {
    const double border = length_ + std::min(down, segment.length);
    append_limits(segment, start_of_plan_.v, work_.zones);
    std::erase_if(work_.zones, [&](const LimitZone& zone) { return zone.begin >= border; });
    asked_.clear();
    append_limits(segment, asked, asked_);
    if (work_.zones.size() > first) {
      work_.zones.back().end = std::min(work_.zones.back().end, border);
    }
    for (LimitZone zone : asked_) {
      if (zone.end > border) {
        zone.begin = std::max(zone.begin, border);
        work_.zones.push_back(zone);
      }
    }
    return;
  }
  append_limits(segment, asked, work_.zones);
  if (is_certified_ && first > 0 && first < work_.zones.size()) {
    continue_zone(first);
  }
}

void LookAhead::append_limits(const path::Segment& segment, double feedrate,
                              std::vector<LimitZone>& zones) {
  if (is_certified_) {
    certified_limits_.append(segment, length_, feedrate, zones);
  } else {
    append_segment_limits(segment, length_, feedrate, rules_, zones);
  }
}

/// Makes a zone part of the one before it, where that ends at the same place with the same limits.
void LookAhead::continue_zone(std::size_t index) {
  LimitZone& before = work_.zones[index - 1];
  const LimitZone& zone = work_.zones[index];
  if (before.end > before.begin && zone.end > zone.begin && before.end == zone.begin &&
      before.limit == zone.limit && before.acceleration == zone.acceleration &&
      before.jerk == zone.jerk) {
    before.end = zone.end;
    work_.zones.erase(work_.zones.begin() + static_cast<std::ptrdiff_t>(index));
  }
}

/// What is left of A and J to brake with from a segment on, as far as that may take.
RampLimits LookAhead::brake_limits(std::size_t zone, double begin, double end) const {
  RampLimits least{ramp_.acceleration, ramp_.jerk, ramp_.profile};
  if (!has_axis_limits_ || !is_certified_) {
    return least;
  }
  double fastest = 0.0;
  for (; zone < work_.zones.size(); ++zone) {
    const LimitZone& next = work_.zones[zone];
    if (next.begin < end) {
      fastest = std::max(fastest, next.limit);
    } else if (next.begin > end + ramp_distance(fastest, 0.0, least)) {
      break;
    }
    if (next.end > begin) {
      least.acceleration = std::min(least.acceleration, next.acceleration);
      least.jerk = std::min(least.jerk, next.jerk);
    }
  }
  return least;
}

void LookAhead::finish() {
  if (!window_.empty()) {
    plan(true);
  }
}

/// Whether enough of the path has come since the last plan: with the certified planner some braking
/// distances of it, however many segments those are.
bool LookAhead::is_due() const {
  if (!is_certified_) {
    return window_.size() >= look_ahead_;
  }
  return length_ >= due_length_ || window_.size() >= due_segments_ ||
         work_.zones.size() >= due_zones_;
}

void LookAhead::wait_for_more() {
  const double braking = longest_descent(fastest_, fastest_, ramp_);
  due_length_ = length_ + kBrakingDistances * braking + horizon_margin();
  due_segments_ = std::max(window_.size() + look_ahead_, kMostSegments / 4);
  due_zones_ = work_.zones.size() + std::max(work_.zones.size(), kFewestZones);
}

double LookAhead::horizon_margin() const { return kHidingPeriods * limits_.feedrate * period_; }

/// Where a plan ends at rest: up to there no later corner lowers a limit any more.
double LookAhead::horizon(bool is_last) const {
  return is_last ? length_ : length_ - horizon_margin();
}

void LookAhead::plan(bool is_last) {
  const double last = horizon(is_last);
  if (last > work_.start.s + kPlaceRounding || is_last) {
    const bool is_full = is_certified_ && window_.size() >= kMostSegments;
    planner_->advance(work_, last, is_last || is_full);
    fallbacks_ += is_full && !is_last ? 1 : 0;
    emit_covered(is_last);
  }
  wait_for_more();
}

void LookAhead::emit_covered(bool is_last) {
  double begin = 0.0;
  std::size_t next_phase = 0;
  std::size_t next_zone = 0;
  while (!window_.empty() &&
         (is_last || begin + window_.front().length <= work_.start.s - kPlaceRounding)) {
    PlannedSegment planned;
    planned.segment = std::move(window_.front());
    planned.index = next_index_++;
    window_.pop_front();
    const double end = begin + planned.segment.length;
    planned.brake = brake_limits(next_zone, begin, end);
    take_phases(begin, end, next_phase, planned);
    for (; next_zone < work_.zones.size() && work_.zones[next_zone].end <= end + kPlaceRounding;
         ++next_zone) {
      const LimitZone& zone = work_.zones[next_zone];
      planned.limits.push_back(part_of(zone, begin, end));
    }
    if (next_zone < work_.zones.size() && work_.zones[next_zone].begin < end - kPlaceRounding) {
      planned.limits.push_back(part_of(work_.zones[next_zone], begin, end));  // goes on after it
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
  for (; next < work_.phases.size(); ++next) {
    Phase phase = work_.phases[next];
    if (phase.s > end + kPlaceRounding) {
      break;  // the plan starts in a later segment
    }
    const bool crosses = motion_at(phase, phase.duration).s > end + kPlaceRounding;
    if (crosses) {
      const double t = time_at(phase, end);
      work_.phases[next] = remainder_after(phase, t);
      work_.phases[next].s = end;
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
  work_.phases.erase(work_.phases.begin(),
                     work_.phases.begin() + static_cast<std::ptrdiff_t>(phases));
  work_.zones.erase(work_.zones.begin(), work_.zones.begin() + static_cast<std::ptrdiff_t>(zones));
  for (Phase& phase : work_.phases) {
    phase.s -= begin;
  }
  for (LimitZone& zone : work_.zones) {
    zone.begin -= begin;
    zone.end -= begin;
  }
  junctions_.forget(begin, zones);
  planner_->forget(begin);
  work_.start.s -= begin;
  start_of_plan_.s -= begin;
  length_ -= begin;
}

}  // namespace twin::feedrate

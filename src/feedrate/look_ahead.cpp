#include "feedrate/look_ahead.hpp"

#include <utility>

#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// The part of a zone within [begin, end], measured from begin.
LimitZone part_of(LimitZone zone, double begin, double end) {
  zone.begin = zone.begin < begin - kPlaceRounding ? 0.0 : zone.begin - begin;
  zone.end = (zone.end > end + kPlaceRounding ? end : zone.end) - begin;
  return zone;
}

}  // namespace

LookAhead::LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                     double period, Sink sink, Start start, double override_scale)
    : LookAhead(*make_planner(limits, model, path, period), limits, model, period, std::move(sink),
                start, override_scale) {}

LookAhead::LookAhead(const PlannerParts& parts, const Limits& limits, const PlanningModel& model,
                     double period, Sink sink, const Start& start, double override_scale)
    : limits_(limits, model, period, parts.make_limits(), start, override_scale),
      planner_(parts.make_window_planner()),
      sink_(std::move(sink)) {
  window_.start = {start.s, start.v};
}

void LookAhead::push(path::Segment&& segment) {
  limits_.append(segment, window_);
  window_.length += segment.length;
  window_.segments.push_back(std::move(segment));
  if (planner_->is_due(window_)) {
    plan(Tail::kOpen);
  }
}

void LookAhead::finish() {
  if (!window_.segments.empty()) {
    plan(Tail::kClosed);
  }
}

void LookAhead::plan(Tail tail) {
  if (planner_->plan(window_, tail)) {
    emit_final(tail);
  }
  planner_->schedule(window_);
}

/// Hands on the segments before the window's start; all of them where the path has ended.
void LookAhead::emit_final(Tail tail) {
  double begin = 0.0;
  std::size_t next_phase = 0;
  std::size_t next_zone = 0;
  std::size_t next_stretch = 0;
  while (!window_.segments.empty() &&
         (tail == Tail::kClosed ||
          begin + window_.segments.front().length <= window_.start.s - kPlaceRounding)) {
    PlannedSegment planned;
    planned.segment = std::move(window_.segments.front());
    planned.index = next_index_++;
    window_.segments.pop_front();
    const double end = begin + planned.segment.length;
    append_phases(begin, end, next_phase, planned);
    append_limits(begin, end, next_zone, planned);
    append_stretches(begin, end, next_stretch, planned);
    begin = end;
    sink_(std::move(planned));
  }
  forget(begin, next_phase, next_zone, next_stretch);
}

/// Moves the phases within [begin, end] to a segment, and cuts the one that goes on after it.
/// @param next  the first phase that is left; becomes the first one after the segment
void LookAhead::append_phases(double begin, double end, std::size_t& next,
                              PlannedSegment& planned) {
  if (planned.segment.length == 0.0) {
    planned.phases.push_back({planned.segment.dwell, 0.0, 0.0, 0.0, 0.0});
    return;
  }
  for (; next < window_.phases.size(); ++next) {
    Phase phase = window_.phases[next];
    if (phase.s > end + kPlaceRounding) {
      break;  // the plan starts in a later segment
    }
    const bool crosses = motion_at(phase, phase.duration).s > end + kPlaceRounding;
    if (crosses) {
      const double t = time_at(phase, end);
      window_.phases[next] = remainder_after(phase, t);
      window_.phases[next].s = end;
      phase.duration = t;
    }
    phase.s -= begin;
    planned.phases.push_back(phase);
    if (crosses) {
      break;
    }
  }
}

/// Copies the zones within [begin, end] to a segment.
/// @param next  the first zone that reaches beyond `begin`; becomes that of `end`
void LookAhead::append_limits(double begin, double end, std::size_t& next,
                              PlannedSegment& planned) const {
  const std::vector<LimitZone>& zones = window_.zones;
  std::size_t last = next;
  while (last < zones.size() && zones[last].begin < end) {
    ++last;
  }
  planned.limits.reserve(last - next + 2);
  for (; next < zones.size() && zones[next].end <= end + kPlaceRounding; ++next) {
    planned.limits.push_back(part_of(zones[next], begin, end));
  }
  if (next < zones.size() && zones[next].begin < end - kPlaceRounding) {
    planned.limits.push_back(part_of(zones[next], begin, end));  // goes on after it
  }
}

/// Copies the stretches that reach into [begin, end] to a segment.
/// @param next  the first stretch that ends beyond `begin`; becomes that of `end`
void LookAhead::append_stretches(double begin, double end, std::size_t& next,
                                 PlannedSegment& planned) const {
  const std::vector<Stretch>& stretches = window_.stretches;
  for (std::size_t i = next; i < stretches.size(); ++i) {
    Stretch stretch = stretches[i];
    next = stretch.end <= end + kPlaceRounding ? i + 1 : i;
    stretch.end -= begin;
    stretch.rest -= begin;
    planned.stretches.push_back(stretch);
    if (next == i) {
      break;
    }
  }
}

/// Drops what was handed on and measures everything from the new window's start.
void LookAhead::forget(double distance, std::size_t phases, std::size_t zones,
                       std::size_t stretches) {
  window_.phases.erase(window_.phases.begin(),
                       window_.phases.begin() + static_cast<std::ptrdiff_t>(phases));
  window_.zones.erase(window_.zones.begin(),
                      window_.zones.begin() + static_cast<std::ptrdiff_t>(zones));
  window_.stretches.erase(window_.stretches.begin(),
                          window_.stretches.begin() + static_cast<std::ptrdiff_t>(stretches));
  for (Phase& phase : window_.phases) {
    phase.s -= distance;
  }
  for (Stretch& stretch : window_.stretches) {
    stretch.end -= distance;
    stretch.rest -= distance;
  }
  for (LimitZone& zone : window_.zones) {
    zone.begin -= distance;
    zone.end -= distance;
  }
  limits_.forget(distance, zones);
  planner_->forget(distance);
  window_.start.s -= distance;
  window_.length -= distance;
}

}  // namespace twin::feedrate

#include "feedrate/bound/time_bound.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "feedrate/bound/reach.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "feedrate/tolerances.hpp"

namespace twin::feedrate {
namespace {

/// Change of time below which a grid is fine enough [-], and the most halvings of it. A larger
/// change saves halvings, each of which is twice the work of the one before, and gives a bound that
/// is less sharp by as much.
constexpr double kSameTime = 3e-4;
constexpr int kMostHalvings = 6;

/// The geometry of a segment without its blocks.
path::Segment bare(const path::Segment& segment) {
  path::Segment copy;
  copy.geometry = segment.geometry;
  copy.length = segment.length;
  copy.feedrate = segment.feedrate;
  copy.begin = segment.begin;
  copy.end = segment.end;
  return copy;
}

}  // namespace

TimeBound::TimeBound(const Limits& limits, const PlanningModel& model, const PathSettings& path,
                     double period, Profile profile)
    : limits_(limits), rules_(limits, model, path, period), profile_(std::move(profile)) {
  if (!has_axis_limits(limits) && limits.jerk_of == JerkOf::kPath) {
    jerk_bound_.emplace(RampLimits{limits.acceleration, limits.jerk});
  }
}

void TimeBound::add(const feedrate::PlannedSegment& planned) {
  const path::Segment& segment = planned.segment;
  if (segment.length <= 0.0) {
    time_ += segment.dwell;
    dwell_ += segment.dwell;
    if (!open_.empty()) {
      open_.back().end_cap = 0.0;
    }
    return;
  }
  OpenSegment open{bare(segment), planned.limits, segment.stops_at_end ? 0.0 : kNoCap};
  for (const feedrate::LimitZone& zone : planned.limits) {
    const double q = zone.limit * zone.limit;
    // A corner: of this segment's end, or of its begin. A place inside is the planner's own.
    if (zone.begin == zone.end && zone.begin >= segment.length - kPlaceRounding) {
      open.end_cap = std::min(open.end_cap, q);
    } else if (zone.begin == zone.end && zone.end <= kPlaceRounding && !open_.empty()) {
      open_.back().end_cap = std::min(open_.back().end_cap, q);
    }
  }
  open_.push_back(std::move(open));
  if (open_.size() >= next_look_) {
    release(Tail::kOpen);
  }
}

double TimeBound::finish() {
  if (!open_.empty()) {
    release(Tail::kClosed);
  }
  if (jerk_bound_) {
    with_jerk_ = dwell_ + jerk_bound_->finish();
  }
  return time_;
}

/// Cells of the first segments, and the cap of each place between them.
void TimeBound::make_grid(std::size_t segments, const Fineness& fineness, Pass& pass) const {
  pass.cells.clear();
  pass.first.assign(1, 0);
  for (std::size_t i = 0; i < segments; ++i) {
    append_cells(open_[i].segment, open_[i].zones, rules_, limits_, fineness, pass.cells);
    pass.first.push_back(pass.cells.size());
  }
  const std::size_t n = pass.cells.size();
  pass.node.assign(n + 1, kNoCap);
  for (std::size_t i = 0; i < n; ++i) {
    pass.node[i] = std::min(pass.node[i], pass.cells[i].cap);
    pass.node[i + 1] = pass.cells[i].cap;
  }
  for (std::size_t i = 0; i < segments; ++i) {
    double& cap = pass.node[pass.first[i + 1]];
    cap = std::min(cap, open_[i].end_cap);
  }
}

/// Lowers each place to the largest q from which the rest can be kept.
void TimeBound::run_backward(double end, Pass& pass) {
  pass.node.back() = std::min(pass.node.back(), end);
  for (std::size_t i = pass.cells.size(); i-- > 0;) {
    pass.node[i] = std::min(pass.node[i], largest_begin(pass.cells[i], pass.node[i + 1]));
  }
}

/// Forward pass: the time until the begin of a segment [s]; pass.node then has the q reached.
double TimeBound::time_until(std::size_t segment, Pass& pass) const {
  double time = 0.0;
  pass.node[0] = std::min(pass.node[0], start_);
  for (std::size_t i = 0; i < pass.first[segment]; ++i) {
    pass.node[i + 1] = largest_end(pass.cells[i], pass.node[i], pass.node[i + 1]);
    time += cell_time(pass.cells[i], pass.node[i], pass.node[i + 1]);
  }
  return time;
}

/// How many of the first segments have a time that does not depend on what follows the last one.
/// The pass is left as from the cap at the end.
std::size_t TimeBound::final_segments(Pass& pass) const {
  Pass from_rest = pass;
  run_backward(0.0, from_rest);
  run_backward(kNoCap, pass);
  for (std::size_t i = pass.first.size() - 1; i > 0; --i) {
    if (pass.node[pass.first[i]] == from_rest.node[pass.first[i]]) {
      return i;
    }
  }
  return 0;
}

/// Calls take(s, v, time since the last place) for each place of the first segments.
template <class Take>
void TimeBound::for_places(std::size_t segment, const Pass& pass, const Take& take) const {
  double s = s_;
  for (std::size_t i = 0; i < pass.first[segment]; ++i) {
    const Cell& cell = pass.cells[i];
    const double q0 = pass.node[i];
    const double q1 = pass.node[i + 1];
    const double time = cell_time(cell, q0, q1);
    take(s, std::sqrt(q0), 0.0);
    double rest = time;
    if (!is_linear(cell, q0, q1)) {
      const double peak = cell_peak(cell, q0, q1);
      const double rise = (std::sqrt(peak) - std::sqrt(q0)) / cell.acceleration;
      const double fall = (std::sqrt(peak) - std::sqrt(q1)) / cell.acceleration;
      take(s + (peak - q0) / (2.0 * cell.acceleration), std::sqrt(peak), rise);
      take(s + cell.length - (peak - q1) / (2.0 * cell.acceleration), std::sqrt(peak),
           time - rise - fall);
      rest = fall;
    }
    s += cell.length;
    take(s, std::sqrt(q1), rest);
  }
}

void TimeBound::report(std::size_t segment, const Pass& pass) {
  for_places(segment, pass, [&](double s, double v, double time) {
    if (profile_) {
      profile_(s, v);
    }
    if (jerk_bound_) {
      jerk_bound_->add(s, v, time);
    }
  });
}

void TimeBound::release(Tail tail) {
  Fineness fineness;
  Pass pass;
  make_grid(open_.size(), fineness, pass);
  std::size_t until = open_.size();
  if (tail == Tail::kClosed) {
    run_backward(0.0, pass);
  } else {
    until = final_segments(pass);
    if (until == 0 && open_.size() < kMostSegments) {
      next_look_ = 2 * open_.size();
      return;
    }
    until = until == 0 ? open_.size() / 2 : until;
  }
  const double end = pass.node[pass.first[until]];
  double time = time_until(until, pass);
  double fall = 0.0;  // of the time from the last grid but one to the last
  for (int i = 0; i < kMostHalvings; ++i) {
    const double coarse = time;
    fineness = fineness.halved();
    make_grid(until, fineness, pass);
    run_backward(end, pass);
    time = time_until(until, pass);
    fall = std::max(coarse - time, 0.0);
    if (std::abs(time - coarse) <= kSameTime * time) {
      break;
    }
  }
  if (profile_ || jerk_bound_) {
    report(until, pass);
  }
  time_ += time - fall;
  start_ = pass.node[pass.first[until]];
  for (std::size_t i = 0; i < until; ++i) {
    s_ += open_[i].segment.length;
  }
  open_.erase(open_.begin(), open_.begin() + static_cast<std::ptrdiff_t>(until));
  next_look_ = open_.size() + kWindow;
}

}  // namespace twin::feedrate

#include "following.hpp"

#include <algorithm>

#include "tests/support/blocks.hpp"

namespace twin::test {
namespace {

using feedrate::PlannedSegment;

Vec3 place_on(const path::Segment& segment, double s) {
  if (const auto* line = std::get_if<path::Line>(&segment.geometry)) {
    return path::point_at(*line, s).position;
  }
  if (const auto* arc = std::get_if<path::Arc>(&segment.geometry)) {
    return path::point_at(*arc, s).position;
  }
  if (const auto* fitted = std::get_if<path::FittedCurve>(&segment.geometry)) {
    return fitted->curve.position(fitted->arc_length.u_at(fitted->curve, s, 0.0));
  }
  return segment.begin.position;
}

std::vector<Vec3> wave(const Vec3& start, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    const double x = 0.05 * i;
    points.push_back(start + Vec3(x, 0.8 * std::sin(x) * std::sin(x), 0.0));
  }
  return points;
}

}  // namespace

const PlannedSegment* PlanSource::next() noexcept {
  if (is_finished() || (starve_every_ != 0 && ++asked_ % starve_every_ != 0)) {
    return nullptr;
  }
  return &plan_.segments[next_++];
}

void PlanSource::release(const PlannedSegment* segment) noexcept {
  released_ += segment == &plan_.segments[released_] ? 1 : 0;
}

ReplanSource::ReplanSource(const Plan& plan, double period, double scale)
    : period_(period), scale_(scale), plans_{plan.segments} {
  for (const PlannedSegment& planned : plan.segments) {
    path_.push_back(planned.segment);
  }
}

std::int64_t ReplanSource::plan_from(std::int64_t segment, double s, double v) {
  const auto number = static_cast<std::int64_t>(plans_.size());
  std::vector<PlannedSegment> again;
  feedrate::LookAhead look_ahead(
      {}, {}, {}, period_,
      [&](PlannedSegment&& planned) {
        planned.index += segment;
        planned.plan = number;
        again.push_back(std::move(planned));
      },
      {s, v}, scale_);
  for (auto i = static_cast<std::size_t>(segment); i < path_.size(); ++i) {
    look_ahead.push(path::Segment(path_[i]));
  }
  look_ahead.finish();
  plans_.push_back(std::move(again));
  return number;
}

const PlannedSegment* ReplanSource::next() noexcept {
  return is_finished() ? nullptr : &segments()[next_++];
}

void ReplanSource::adopt(std::int64_t plan) noexcept {
  plan_ = plan;
  next_ = 0;
}

std::vector<motion::SetPoint> follow(const Plan& plan, double period, std::size_t starve_every,
                                     const motion::InterpolatorSettings& settings) {
  PlanSource source(plan, starve_every);
  motion::Interpolator interpolator(source, period, settings);
  std::vector<motion::SetPoint> points;
  motion::SetPoint point;
  for (motion::Status status = motion::Status::kMoving; status != motion::Status::kDone;) {
    status = interpolator.step(point);
    if (status == motion::Status::kMoving) {
      points.push_back(point);
    }
  }
  return points;
}

double distance_at(const Plan& plan, double time) {
  double before = 0.0;
  for (const PlannedSegment& planned : plan.segments) {
    for (const feedrate::Phase& phase : planned.phases) {
      if (time <= phase.duration) {
        return before + feedrate::motion_at(phase, time).s;
      }
      time -= phase.duration;
    }
    before += planned.segment.length;
  }
  return before;
}

Vec3 place_at_distance(const Plan& plan, double distance) {
  for (const PlannedSegment& planned : plan.segments) {
    if (distance <= planned.segment.length) {
      return place_on(planned.segment, distance);
    }
    distance -= planned.segment.length;
  }
  return plan.segments.back().segment.end.position;
}

Vec3 place_at(const Plan& plan, double time) {
  return place_at_distance(plan, distance_at(plan, time));
}

Plan smooth_plan(double period) {
  PlanSettings settings;
  settings.period = period;
  return plan(polyline(wave(Vec3::Zero(), 400)), settings);
}

Plan mixed_plan(double period) {
  std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {11, 0, 0}),
                                   arc_block({11, 0, 0}, {1, 0, 0}, 3.0, 2.0, true)};
  blocks.push_back(line_block(blocks.back().end, {10, 10, 0}));
  for (const gcode::Block& block : polyline(wave({10, 10, 0}, 150))) {
    blocks.push_back(block);
  }
  blocks.push_back(dwell_block(blocks.back().end, 0.05));
  blocks.push_back(line_block(blocks.back().end, blocks.back().end + Vec3(0, 0, 11), 30.0));
  blocks.back().path_mode = gcode::PathMode::kExactStop;
  blocks.push_back(line_block(blocks.back().end, blocks.back().end + Vec3(0, 0, 11), 30.0));
  PlanSettings settings;
  settings.period = period;
  return plan(blocks, settings);
}

}  // namespace twin::test

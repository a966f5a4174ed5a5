#include "motion/interpolator/interpolator.hpp"

#include <algorithm>

namespace twin::motion {
namespace {

constexpr double kRestRounding = 1e-6;  // place where braking ends [mm]

}  // namespace

Interpolator::~Interpolator() {
  if (current_ != nullptr) {
    source_.release(current_);
  }
}

/// Takes the next segment. Where another plan goes on inside a segment, it is the same piece of
/// path again.
bool Interpolator::fetch() noexcept {
  const feedrate::PlannedSegment* next = source_.next();
  if (next == nullptr) {
    return false;
  }
  const bool is_same = current_ != nullptr && current_->index == next->index;
  if (current_ != nullptr) {
    passed_ += is_same ? 0.0 : current_->segment.length;
    source_.release(current_);
  }
  current_ = next;
  zone_ = 0;
  if (is_same) {
    return true;
  }
  mark_ = 0;
  elapsed_ = 0.0;
  has_landed_ = false;
  const auto& phases = current_->phases;
  follower_.enter(phases.empty() ? feedrate::PathMotion{} : feedrate::motion_at(phases[0], 0.0));
  return true;
}

/// The plan that was armed is the one to follow.
void Interpolator::take_over() noexcept {
  between_ = feedrate::motion_at(current_->phases[armed_->phase], armed_->time);
  plan_ = armed_->plan;
  armed_.reset();
  source_.adopt(plan_);
}

Status Interpolator::step(SetPoint& out) noexcept {
  if (is_done_) {
    return Status::kDone;
  }
  if (mode_ == Mode::kRest) {
    return Status::kAtRest;
  }
  if (current_ == nullptr) {
    if (!fetch()) {
      return source_.is_finished() ? Status::kDone : Status::kStarved;
    }
    put_place(out);
    return Status::kMoving;
  }
  const double dt = is_waiting_ ? 0.0 : period_;
  const Status status = mode_ == Mode::kBrake ? advance_brake(dt) : advance_plan(dt);
  is_waiting_ = status == Status::kStarved;
  if (status == Status::kMoving) {
    put_place(out);
  }
  return status;
}

/// Whether the current curve's end, just reached, takes a set point of its own.
bool Interpolator::lands_here() noexcept {
  if (!lands_ || has_landed_ ||
      !std::holds_alternative<path::FittedCurve>(current_->segment.geometry)) {
    return false;
  }
  has_landed_ = true;
  pending_ = 0.0;
  return true;
}

Status Interpolator::advance_plan(double dt) noexcept {
  pending_ += dt;
  elapsed_ = 0.0;
  for (;;) {
    const std::size_t count = is_between_   ? 0
                              : ends_here() ? armed_->phase + 1
                                            : current_->phases.size();
    for (; phase_ < count; ++phase_) {
      const bool is_cut = ends_here() && phase_ == armed_->phase;
      const double left = (is_cut ? armed_->time : current_->phases[phase_].duration) - time_;
      if (pending_ < left) {
        time_ += pending_;
        elapsed_ += pending_;
        pending_ = 0.0;
        return Status::kMoving;
      }
      pending_ -= left;
      elapsed_ += left;
      time_ = 0.0;
    }
    if (ends_here()) {
      take_over();
      is_between_ = true;
    } else if (!is_between_ && lands_here()) {
      return Status::kMoving;
    }
    if (!fetch()) {
      is_done_ = source_.is_finished();
      return is_done_ ? Status::kMoving : Status::kStarved;
    }
    is_between_ = false;
    phase_ = 0;
  }
}

Status Interpolator::advance_brake(double dt) noexcept {
  time_ = std::min(time_ + pending_ + dt, brake_.duration);
  pending_ = 0.0;
  // Where the plan rests at the segment's end, so does braking, but for rounding.
  const auto rests_here = [this] {
    return brake_.phases.front().s + brake_.distance <= current_->segment.length + kRestRounding;
  };
  for (double s = motion().s; s > current_->segment.length && !rests_here(); s = motion().s) {
    const std::int64_t index = current_->index;
    const double length = current_->segment.length;
    if (ends_here()) {
      take_over();
    }
    if (!fetch()) {
      is_done_ = source_.is_finished();  // rest falls on the path's end, beyond it by rounding
      return is_done_ ? Status::kMoving : Status::kStarved;
    }
    if (current_->index == index) {
      continue;
    }
    for (feedrate::Phase& phase : brake_.phases) {
      phase.s -= length;
    }
  }
  if (time_ >= brake_.duration) {
    between_ = {std::clamp(motion().s, 0.0, current_->segment.length), 0.0, 0.0};
    has_landed_ = false;
    mode_ = Mode::kRest;
  }
  return Status::kMoving;
}

void Interpolator::brake(const feedrate::RampLimits& limits) noexcept {
  if (mode_ != Mode::kPlan || is_done_) {
    return;
  }
  if (current_ == nullptr) {
    is_done_ = true;
    return;
  }
  brake_ = brake_from_here(limits);
  time_ = 0.0;
  is_between_ = false;
  mode_ = Mode::kBrake;
}

feedrate::Brake Interpolator::brake_from_here(feedrate::RampLimits limits) const noexcept {
  const feedrate::RampLimits& planned = current_->brake;
  if (planned.acceleration > 0.0) {
    limits.acceleration = std::min(limits.acceleration, planned.acceleration);
    limits.jerk = std::min(limits.jerk, planned.jerk);
  }
  return feedrate::make_brake(motion(), limits);
}

bool Interpolator::arm(const PlanSwitch& at) noexcept {
  if (mode_ != Mode::kPlan || is_between_ || is_done_ || current_ == nullptr) {
    return false;
  }
  const bool is_here = current_->index == at.segment;
  const bool is_phase_ahead = phase_ < at.phase || (phase_ == at.phase && time_ <= at.time);
  if (current_->index > at.segment || (is_here && !is_phase_ahead)) {
    return false;
  }
  armed_ = at;
  return true;
}

void Interpolator::adopt(std::int64_t plan) noexcept {
  if (mode_ == Mode::kRest) {
    armed_.reset();
    plan_ = plan;
    source_.adopt(plan);
  }
}

void Interpolator::resume() noexcept {
  if (mode_ == Mode::kRest) {
    mode_ = Mode::kPlan;
    is_between_ = true;
    phase_ = 0;
    time_ = 0.0;
  }
}

void Interpolator::finish() noexcept { is_done_ = is_done_ || mode_ == Mode::kRest; }

PlanPlace Interpolator::place() const noexcept {
  return {current_->index, phase_, time_, motion().s};
}

double Interpolator::distance() const noexcept {
  return current_ == nullptr ? 0.0 : passed_ + motion().s;
}

double Interpolator::braking_distance(const feedrate::RampLimits& limits) const noexcept {
  return current_ == nullptr ? 0.0 : brake_from_here(limits).distance;
}

feedrate::PathMotion Interpolator::motion() const noexcept {
  if (mode_ == Mode::kRest || is_between_) {
    return between_;
  }
  if (mode_ == Mode::kBrake) {
    double t = time_;
    std::size_t i = 0;
    for (; i + 1 < brake_.phases.size() && t > brake_.phases[i].duration; ++i) {
      t -= brake_.phases[i].duration;
    }
    return feedrate::motion_at(brake_.phases[i], t);
  }
  if (phase_ >= current_->phases.size()) {
    feedrate::PathMotion end{current_->segment.length, 0.0, 0.0};
    if (!current_->phases.empty() && !is_done_) {
      const feedrate::Phase& last = current_->phases.back();
      end.v = feedrate::motion_at(last, last.duration).v;
    }
    return end;
  }
  return feedrate::motion_at(current_->phases[phase_], time_);
}

path::PathPoint Interpolator::locate(const feedrate::PathMotion& m) noexcept {
  const path::Segment& segment = current_->segment;
  if (const auto* line = std::get_if<path::Line>(&segment.geometry)) {
    return path::point_at(*line, m.s);
  }
  if (const auto* arc = std::get_if<path::Arc>(&segment.geometry)) {
    return path::point_at(*arc, m.s);
  }
  const auto* fitted = std::get_if<path::FittedCurve>(&segment.geometry);
  if (fitted == nullptr) {
    return segment.begin;
  }
  if (has_landed_) {
    return segment.end;
  }
  return follower_.follow(*fitted, m, elapsed_, period_, mode_ != Mode::kPlan);
}

void Interpolator::put_place(SetPoint& out) noexcept {
  feedrate::PathMotion m = is_done_ ? feedrate::PathMotion{motion().s, 0.0, 0.0} : motion();
  m.s = std::clamp(m.s, 0.0, current_->segment.length);
  const path::PathPoint at = locate(m);
  out.position = at.position;
  out.velocity = m.v * at.tangent;
  out.acceleration = m.a * at.tangent + m.v * m.v * at.curvature;
  out.feedrate = m.v;
  mark_place(m.s, out);
}

void Interpolator::mark_place(double s, SetPoint& out) noexcept {
  const auto& marks = current_->segment.marks;
  while (mark_ + 1 < marks.size() && s > marks[mark_].end) {
    ++mark_;
  }
  const auto& zones = current_->limits;
  while (zone_ + 1 < zones.size() && s > zones[zone_].end) {
    ++zone_;
  }
  out.segment = current_->index;
  out.block = marks.empty() ? 0 : marks[mark_].block;
  out.line = marks.empty() ? 0 : marks[mark_].line;
  out.feedrate_limit = zones.empty() ? 0.0 : zones[zone_].limit;
}

}  // namespace twin::motion

#include "interpolator/interpolator.hpp"

#include <algorithm>

namespace twin::interpolator {
namespace {

constexpr double kResumeTime = 1.0;     // from rest back to the plan's full rate [s]
constexpr double kRestRounding = 1e-6;  // place where braking ends [mm]

}  // namespace

Interpolator::~Interpolator() {
  if (current_ != nullptr) {
    source_.release(current_);
  }
}

bool Interpolator::fetch() noexcept {
  const feedrate::PlannedSegment* next = source_.next();
  if (next == nullptr) {
    return false;
  }
  if (current_ != nullptr) {
    source_.release(current_);
  }
  current_ = next;
  mark_ = 0;
  zone_ = 0;
  elapsed_ = 0.0;
  has_landed_ = false;
  const auto& phases = current_->phases;
  follower_.enter(phases.empty() ? feedrate::PathMotion{} : feedrate::motion_at(phases[0], 0.0));
  return true;
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
    place(out);
    return Status::kMoving;
  }
  double dt = is_waiting_ ? 0.0 : period_;
  if (mode_ == Mode::kPlan && rate_time_ >= 0.0 && !is_waiting_) {
    rate_time_ += period_;
    const double x = std::min(rate_time_ / kResumeTime, 1.0);
    const double before = rate_;
    rate_ = x * x * (3.0 - 2.0 * x);
    rate_change_ = 6.0 * x * (1.0 - x) / kResumeTime;
    dt *= 0.5 * (before + rate_);
    rate_time_ = x < 1.0 ? rate_time_ : -1.0;
  }
  const Status status = mode_ == Mode::kBrake ? advance_brake(dt) : advance_plan(dt);
  is_waiting_ = status == Status::kStarved;
  if (status == Status::kMoving) {
    place(out);
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
    for (; phase_ < current_->phases.size(); ++phase_) {
      const double left = current_->phases[phase_].duration - time_;
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
    if (lands_here()) {
      return Status::kMoving;
    }
    if (!fetch()) {
      is_done_ = source_.is_finished();
      return is_done_ ? Status::kMoving : Status::kStarved;
    }
    phase_ = 0;
  }
}

Status Interpolator::advance_brake(double dt) noexcept {
  time_ = std::min(time_ + dt, brake_.duration);
  // Where the plan rests at the segment's end, so does braking, but for rounding.
  const auto rests_here = [this] {
    return brake_.phases.front().s + brake_.distance <= current_->segment.length + kRestRounding;
  };
  for (double s = motion().s; s > current_->segment.length && !rests_here(); s = motion().s) {
    const double length = current_->segment.length;
    if (!fetch()) {
      is_done_ = source_.is_finished();  // rest falls on the path's end, beyond it by rounding
      return is_done_ ? Status::kMoving : Status::kStarved;
    }
    phase_ = 0;
    for (feedrate::Phase& phase : brake_.phases) {
      phase.s -= length;
    }
  }
  if (time_ >= brake_.duration) {
    rejoin_plan();
  }
  return Status::kMoving;
}

/// At rest after braking: finds the place in the plan, from where resume() goes on.
void Interpolator::rejoin_plan() noexcept {
  const double s = std::min(motion().s, current_->segment.length);
  const auto& phases = current_->phases;
  for (phase_ = 0; phase_ + 1 < phases.size() && phases[phase_ + 1].s <= s; ++phase_) {
  }
  const bool is_dwell = current_->segment.length == 0.0;  // it begins again
  time_ = phases.empty() || is_dwell ? 0.0 : feedrate::time_at(phases[phase_], s);
  pending_ = 0.0;
  rate_ = 0.0;
  rate_change_ = 0.0;
  has_landed_ = false;
  mode_ = Mode::kRest;
}

void Interpolator::brake(const feedrate::RampLimits& limits) noexcept {
  if (mode_ != Mode::kPlan || is_done_) {
    return;
  }
  if (current_ == nullptr) {
    is_done_ = true;
    return;
  }
  brake_ = feedrate::make_brake(motion(), limits);
  time_ = 0.0;
  mode_ = Mode::kBrake;
}

void Interpolator::resume() noexcept {
  if (mode_ == Mode::kRest) {
    mode_ = Mode::kPlan;
    rate_time_ = 0.0;
  }
}

double Interpolator::braking_distance(const feedrate::RampLimits& limits) const noexcept {
  return current_ == nullptr ? 0.0 : feedrate::make_brake(motion(), limits).distance;
}

double Interpolator::remaining_in_segment() const noexcept {
  return current_ == nullptr ? 0.0 : current_->segment.length - motion().s;
}

feedrate::PathMotion Interpolator::motion() const noexcept {
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
    if (has_landed_) {
      const feedrate::Phase& last = current_->phases.back();
      end.v = feedrate::motion_at(last, last.duration).v;
    }
    return end;
  }
  feedrate::PathMotion m = feedrate::motion_at(current_->phases[phase_], time_);
  m.a = m.a * rate_ * rate_ + m.v * rate_change_;
  m.v *= rate_;
  return m;
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
  const bool is_off_plan = mode_ != Mode::kPlan || rate_ != 1.0;
  return follower_.follow(*fitted, m, elapsed_, period_, is_off_plan);
}

void Interpolator::place(SetPoint& out) noexcept {
  feedrate::PathMotion m =
      is_done_ || mode_ == Mode::kRest ? feedrate::PathMotion{motion().s, 0.0, 0.0} : motion();
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

}  // namespace twin::interpolator

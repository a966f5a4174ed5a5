#include "motion/interpolator/phase_clock.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "feedrate/tolerances.hpp"

namespace twin::motion {
namespace {

/// Stretches that a stop nearby may pass. It bounds the work of one period; twice as many would let
/// few more stops be short.
constexpr int kStretchesNearby = 32;

}  // namespace

PhaseClock::~PhaseClock() {
  if (current_ != nullptr) {
    source_.release(current_);
  }
}

/// Fetches the next segment. Where another plan goes on inside a segment, it is the same piece of
/// path again.
bool PhaseClock::fetch() noexcept {
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
  if (!is_same) {
    elapsed_ = 0.0;
    is_on_curve_end_ = false;
  }
  return true;
}

/// Follows the plan that was armed from here on.
void PhaseClock::take_over() noexcept {
  stand_ = feedrate::motion_at(current_->phases[armed_->phase], armed_->time);
  plan_ = armed_->plan;
  armed_.reset();
  source_.adopt(plan_);
}

Status PhaseClock::advance(double period) noexcept {
  switch (state_) {
    case State::kEnded:
    case State::kEndedByBraking:
      return Status::kDone;
    case State::kAtRest:
      return Status::kAtRest;
    case State::kIdle:
      if (!fetch()) {
        return source_.is_finished() ? Status::kDone : Status::kStarved;
      }
      state_ = State::kFollowing;
      return Status::kMoving;
    default:
      break;
  }
  const double dt = has_starved_ ? 0.0 : period;
  const Status status = state_ == State::kBraking ? follow_brake(dt) : follow(dt);
  has_starved_ = status == Status::kStarved;
  return status;
}

/// No segment was there: the path has ended, or the next one comes later.
Status PhaseClock::end_or_starve(State end) noexcept {
  if (!source_.is_finished()) {
    return Status::kStarved;
  }
  stand_ = {motion().s, 0.0, 0.0};
  state_ = end;
  return Status::kMoving;
}

/// Whether an instant of its own falls on the current segment's end, just reached. The rest of the
/// period is lost then.
bool PhaseClock::land() noexcept {
  if (curve_end_ != CurveEnd::kLand || is_on_curve_end_ ||
      !std::holds_alternative<path::FittedCurve>(current_->segment.geometry)) {
    return false;
  }
  is_on_curve_end_ = true;
  pending_ = 0.0;
  return true;
}

/// Lets the pending time pass in the phases of the current segment, up to the place of a switch.
/// @returns false if the segment ended before the time did
bool PhaseClock::pass_phases() noexcept {
  const std::size_t count = ends_here() ? armed_->phase + 1 : current_->phases.size();
  for (; phase_ < count; ++phase_) {
    const bool is_cut = ends_here() && phase_ == armed_->phase;
    const double left = (is_cut ? armed_->time : current_->phases[phase_].duration) - time_;
    if (pending_ < left) {
      time_ += pending_;
      elapsed_ += pending_;
      pending_ = 0.0;
      return true;
    }
    pending_ -= left;
    elapsed_ += left;
    time_ = 0.0;
  }
  return false;
}

Status PhaseClock::follow(double dt) noexcept {
  pending_ += dt;
  elapsed_ = 0.0;
  for (;;) {
    if (state_ == State::kFollowing) {
      if (pass_phases()) {
        return Status::kMoving;
      }
      if (ends_here()) {
        take_over();
        state_ = State::kBetweenPlans;
      } else if (land()) {
        return Status::kMoving;
      }
    }
    if (!fetch()) {
      return end_or_starve(State::kEnded);
    }
    state_ = State::kFollowing;
    phase_ = 0;
  }
}

Status PhaseClock::follow_brake(double dt) noexcept {
  for (;;) {
    const double time = time_ + pending_ + dt;
    time_ = std::min(time, brake_.duration);
    pending_ = 0.0;
    if (!cross_segments()) {
      return end_or_starve(State::kEndedByBraking);  // rest lies beyond the end by rounding
    }
    if (time_ < brake_.duration) {
      return Status::kMoving;
    }
    if (rests_) {
      stand_ = {std::clamp(motion().s, 0.0, current_->segment.length), 0.0, 0.0};
      is_on_curve_end_ = false;
      state_ = State::kAtRest;
      return Status::kMoving;
    }
    if (!go_on_braking()) {
      return end_or_starve(State::kEndedByBraking);
    }
    pending_ = time - time_;
    time_ = 0.0;
    dt = 0.0;
  }
}

/// Fetches segments until the motion, which brakes, is on the current one. @returns false if there
/// is none
bool PhaseClock::cross_segments() noexcept {
  // Where the plan rests at the segment's end, so does braking, but for rounding.
  const auto ends_here_too = [this] {
    return brake_.phases.front().s + brake_.distance <=
           current_->segment.length + feedrate::kRestRounding;
  };
  for (double s = motion().s; s > current_->segment.length && !ends_here_too(); s = motion().s) {
    const std::int64_t index = current_->index;
    const double length = current_->segment.length;
    if (ends_here()) {
      take_over();
    }
    if (!fetch()) {
      return false;
    }
    if (current_->index == index) {
      continue;
    }
    for (feedrate::Phase& phase : brake_.phases) {
      phase.s -= length;
    }
  }
  return true;
}

/// Begins the part of the stop on the next stretch. @returns false if its segment is not there
bool PhaseClock::go_on_braking() noexcept {
  feedrate::PathMotion from = feedrate::end_of(brake_);
  const bool is_switch =
      ends_here() && armed_->distance - passed_ <= from.s + feedrate::kRestRounding;
  if (is_switch) {
    take_over();
  }
  while (is_switch ? current_->plan != plan_
                   : from.s >= current_->segment.length - feedrate::kPlaceRounding) {
    const std::int64_t index = current_->index;
    const double length = current_->segment.length;
    if (!fetch()) {
      return false;
    }
    from.s = current_->index == index ? from.s : std::max(from.s - length, 0.0);
  }
  begin_stop_part(from);
  return true;
}

void PhaseClock::brake(const feedrate::RampLimits& limits) noexcept {
  if (state_ == State::kIdle) {
    state_ = State::kEnded;
  }
  if (state_ != State::kFollowing && state_ != State::kBetweenPlans) {
    return;
  }
  brake_limits_ = limits;
  begin_stop_part(motion());
  time_ = 0.0;
  state_ = State::kBraking;
}

void PhaseClock::begin_stop_part(const feedrate::PathMotion& from) noexcept {
  const feedrate::StopPart part = stop_part(from, brake_limits_);
  brake_ = part.brake;
  rests_ = part.rests;
}

/// The stop from a place of the current segment, as far as one stretch goes.
feedrate::StopPart PhaseClock::stop_part(const feedrate::PathMotion& from,
                                         const feedrate::RampLimits& limits) const noexcept {
  const feedrate::Stretch stretch = stretch_at(from.s, limits);
  const feedrate::StopPart part = feedrate::make_stop_part(from, stretch);
  if (part.rests || current_->stretches.empty()) {
    return part;
  }
  const auto brake = stop_nearby(from, stretch, limits);
  return brake ? feedrate::StopPart{*brake, true} : part;
}

/// A stop that rests beyond the stretch, on one of the next ones of the segment, with the least
/// acceleration and jerk of those that it passes. It has no acceleration to lose and is nowhere
/// faster than the plan, since the plan is not slower at either end of each of them.
std::optional<feedrate::Brake> PhaseClock::stop_nearby(
    const feedrate::PathMotion& from, const feedrate::Stretch& stretch,
    const feedrate::RampLimits& limits) const noexcept {
  const auto& stretches = current_->stretches;
  if (from.a > 0.0 || std::isfinite(stretch.held_above)) {
    return std::nullopt;
  }
  feedrate::RampLimits ramp = stretch.ramp;
  auto next = std::ranges::find_if(stretches, [&](const feedrate::Stretch& candidate) {
    return candidate.end > from.s + feedrate::kPlaceRounding;
  });
  const double last = std::min(current_->segment.length,
                               armed_ ? armed_->distance - passed_ : current_->segment.length);
  for (int i = 0; i < kStretchesNearby && next != stretches.end(); ++i, ++next) {
    ramp.acceleration = std::min({ramp.acceleration, next->ramp.acceleration, limits.acceleration});
    ramp.jerk = std::min({ramp.jerk, next->ramp.jerk, limits.jerk});
    if (std::isfinite(next->held_above) || next->v < from.v || -from.a > ramp.acceleration ||
        !feedrate::can_rest(from, ramp.jerk)) {
      break;
    }
    const feedrate::Brake brake = feedrate::make_brake(from, ramp);
    if (from.s + brake.distance <= std::min(next->end, last) + feedrate::kRestRounding) {
      return brake;
    }
    if (next->end >= last) {
      break;
    }
  }
  return std::nullopt;
}

/// The stretch of a place of the current segment. It ends at the latest where another plan is to
/// take over, which has stretches of its own.
feedrate::Stretch PhaseClock::stretch_at(double s,
                                         const feedrate::RampLimits& limits) const noexcept {
  const std::vector<feedrate::Stretch>& stretches = current_->stretches;
  if (stretches.empty()) {
    return {.ramp = limits};
  }
  const auto found = std::ranges::find_if(stretches, [s](const feedrate::Stretch& stretch) {
    return stretch.end > s + feedrate::kPlaceRounding;
  });
  // Beyond the last one, which is rounding, its ramp goes on.
  feedrate::Stretch stretch =
      found != stretches.end() ? *found : feedrate::Stretch{.ramp = stretches.back().ramp};
  stretch.ramp.acceleration = std::min(stretch.ramp.acceleration, limits.acceleration);
  stretch.ramp.jerk = std::min(stretch.ramp.jerk, limits.jerk);
  if (armed_ && armed_->distance - passed_ < stretch.end) {
    stretch.end = armed_->distance - passed_;
    stretch.fall = 0.0;
    stretch.is_harder_after = false;
  }
  return stretch;
}

double PhaseClock::braking_distance(const feedrate::RampLimits& limits) const noexcept {
  if (current_ == nullptr) {
    return 0.0;
  }
  const feedrate::PathMotion from = motion();
  const feedrate::StopPart part = stop_part(from, limits);
  return part.rests ? part.brake.distance : stretch_at(from.s, limits).rest - from.s;
}

bool PhaseClock::arm(const PlanSwitch& at) noexcept {
  if (state_ != State::kFollowing) {
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

void PhaseClock::adopt(std::int64_t plan) noexcept {
  if (state_ == State::kAtRest) {
    armed_.reset();
    plan_ = plan;
    source_.adopt(plan);
  }
}

void PhaseClock::resume() noexcept {
  if (state_ == State::kAtRest) {
    state_ = State::kBetweenPlans;
    phase_ = 0;
    time_ = 0.0;
  }
}

void PhaseClock::finish() noexcept {
  if (state_ == State::kAtRest) {
    state_ = State::kEndedByBraking;
  }
}

feedrate::PathMotion PhaseClock::motion() const noexcept {
  switch (state_) {
    case State::kBraking: {
      double t = time_;
      std::size_t i = 0;
      for (; i + 1 < brake_.phases.size() && t > brake_.phases[i].duration; ++i) {
        t -= brake_.phases[i].duration;
      }
      return feedrate::motion_at(brake_.phases[i], t);
    }
    case State::kIdle:
    case State::kFollowing:
      return phase_ < current_->phases.size() ? feedrate::motion_at(current_->phases[phase_], time_)
                                              : motion_after_phases();
    default:
      return stand_;
  }
}

/// Motion at the end of the current segment.
feedrate::PathMotion PhaseClock::motion_after_phases() const noexcept {
  feedrate::PathMotion end{current_->segment.length, 0.0, 0.0};
  if (!current_->phases.empty()) {
    const feedrate::Phase& last = current_->phases.back();
    end.v = feedrate::motion_at(last, last.duration).v;
  }
  return end;
}

PathInstant PhaseClock::instant() const noexcept {
  PathInstant instant{.motion = motion(),
                      .elapsed = elapsed_,
                      .is_curve_end = is_on_curve_end_,
                      .is_braking = state_ == State::kBraking || state_ == State::kAtRest ||
                                    state_ == State::kEndedByBraking};
  instant.motion.s = std::clamp(instant.motion.s, 0.0, current_->segment.length);
  return instant;
}

}  // namespace twin::motion

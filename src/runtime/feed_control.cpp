#include "runtime/feed_control.hpp"
#include "runtime/nap.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

namespace twin::runtime {
namespace {

constexpr std::size_t kMostRecords = 4096;
constexpr double kPeriodsAhead = 20.0;
constexpr double kWallClockMargin = 0.1;  // for planning and for braking [s]
constexpr double kGuardPeriods = 4.0;     // at the largest feedrate, more than Motion's guard wants
constexpr double kLargestMargin = 1.0;    // [s]

}  // namespace

FeedControl::FeedControl(motion::Interpolator& interpolator, SegmentQueue& segments,
                         ReplanLink& link, OperatorPanel& panel, const Options& options)
    : interpolator_(interpolator),
      segments_(segments),
      link_(link),
      panel_(panel),
      options_(options),
      margin_(least_margin()) {
  records_.reserve(kMostRecords);
  take_schedule(0.0);
  wish_ = panel_.wish();
  first_percent_ = percent_ = wish_.percent > 0.0 ? wish_.percent : 100.0;
  if (!wish_.holds() && percent_ != 100.0) {
    record({0.0, percent_, 0.0});
  }
}

/// The schedule's changes that are due go to the panel.
void FeedControl::take_schedule(double t) noexcept {
  const auto& schedule = options_.schedule;
  for (;
       next_change_ < schedule.size() && schedule[next_change_].time <= t + 1e-6 * options_.period;
       ++next_change_) {
    panel_.set_override(schedule[next_change_].percent);
  }
}

/// What is wanted, and since when.
OperatorPanel::Wish FeedControl::wish_at(double t) noexcept {
  const OperatorPanel::Wish wish = panel_.wish();
  if (wish.percent != wish_.percent || wish.is_held != wish_.is_held) {
    wish_ = wish;
    wished_at_ = t;
  }
  return wish;
}

void FeedControl::update(double t, const std::atomic<bool>& stop) {
  take_schedule(t);
  if (!interpolator_.has_started()) {
    return;
  }
  link_.report(interpolator_.place().segment);
  const OperatorPanel::Wish wish = wish_at(t);
  const bool holds = wish.holds();
  if (holds) {
    brake_for_hold(t);
  }
  follow_up(t, holds);
  if (state_ == State::kFollowing && !holds) {
    ask(wish.percent);
  }
  if (!options_.is_wall_clock) {
    while (state_ == State::kAsked && link_.offer() == nullptr && !link_.is_broken() && !stop) {
      nap();
    }
  }
  if (state_ == State::kAsked) {
    look_at_offer(holds);
    follow_up(t, holds);
  }
}

void FeedControl::brake_for_hold(double t) noexcept {
  if (!is_hold_) {
    record({wished_at_, 0.0, t});
  }
  is_hold_ = true;
  interpolator_.brake(options_.ramp);
}

/// Asks for another plan where one is needed.
void FeedControl::ask(double percent) {
  const bool is_at_rest = interpolator_.is_at_rest();
  if (!is_at_rest && (interpolator_.is_braking() || percent == percent_)) {
    return;
  }
  if (rests_first_ && !is_at_rest) {
    interpolator_.brake(options_.ramp);
    return;
  }
  if (!options_.is_wall_clock) {
    while (!link_.is_idle() && !link_.is_broken()) {
      nap();
    }
  }
  if (link_.ask({interpolator_.place(), is_at_rest, margin_, percent})) {
    state_ = State::kAsked;
    asked_percent_ = percent;
    asked_at_rest_ = is_at_rest;
  }
}

double FeedControl::least_margin() const noexcept {
  const double margin = kPeriodsAhead * options_.period;
  return options_.is_wall_clock ? std::max(margin, kWallClockMargin) : margin;
}

/// Takes a plan. On the wall clock the motion must still be able to brake before the place of the
/// switch, should the plan's segments not come in time.
bool FeedControl::accept(const ReplanOffer& offer) noexcept {
  if (asked_at_rest_) {
    interpolator_.adopt(offer.at.plan);
    return true;
  }
  const double room = offer.distance - interpolator_.distance();
  const double needed = interpolator_.braking_distance(options_.ramp) +
                        kGuardPeriods * options_.feedrate * options_.period;
  return (!options_.is_wall_clock || room > needed) && interpolator_.arm(offer.at);
}

void FeedControl::look_at_offer(bool holds) noexcept {
  const ReplanOffer* const offer = link_.offer();
  if (offer == nullptr) {
    return;
  }
  state_ = State::kFollowing;
  const bool still_suits = !holds && interpolator_.is_at_rest() == asked_at_rest_;
  const bool is_plan = offer->kind == ReplanOffer::Kind::kPlan;
  if (still_suits && is_plan && accept(*offer)) {
    state_ = asked_at_rest_ ? State::kPriming : State::kArmed;
    margin_ = least_margin();
    link_.answer(true);
    return;
  }
  if (is_plan && still_suits) {
    margin_ = std::min(2.0 * margin_, kLargestMargin);
  }
  if (still_suits && offer->kind == ReplanOffer::Kind::kPathEnd) {
    percent_ = asked_percent_;  // nothing is left that could change
    interpolator_.finish();
  }
  rests_first_ = still_suits && offer->kind == ReplanOffer::Kind::kOnlyRest;
  link_.answer(false);
}

/// Whether the plan that was taken is the one that is followed by now.
void FeedControl::follow_up(double t, bool holds) noexcept {
  const bool is_at_rest = interpolator_.is_at_rest();
  if (state_ == State::kArmed && interpolator_.plan() == interpolator_.latest_plan()) {
    percent_ = asked_percent_;
    record({wished_at_, percent_, t});
    state_ = State::kFollowing;
  } else if (state_ == State::kArmed && is_at_rest) {
    state_ = State::kFollowing;  // braked before the place of the switch
  } else if (state_ == State::kPriming && !holds &&
             (!options_.is_wall_clock || segments_.is_primed())) {
    if (is_hold_ || percent_ != asked_percent_) {
      record({wished_at_, asked_percent_, t});
    }
    percent_ = asked_percent_;
    is_hold_ = false;
    rests_first_ = false;
    interpolator_.resume();
    state_ = State::kFollowing;
  }
}

void FeedControl::record(const results::OverrideRecord& change) noexcept {
  if (records_.size() < kMostRecords) {
    records_.push_back(change);
  }
}

void FeedControl::show(const results::Sample& sample) noexcept {
  const bool is_still = interpolator_.is_at_rest() || interpolator_.is_braking();
  const MotionState state = !is_still  ? MotionState::kMoving
                            : is_hold_ ? MotionState::kHolding
                                       : MotionState::kStarved;
  panel_.show({state, sample.t, percent_, sample.feedrate, sample.line});
}

void FeedControl::show_end() noexcept {
  OperatorPanel::Display last = panel_.display();
  last.state = MotionState::kEnded;
  panel_.show(last);
}

}  // namespace twin::runtime

#include "runtime/feed_control.hpp"

#include <algorithm>

namespace twin::runtime {
namespace {

constexpr std::size_t kMostRecords = 4096;
constexpr double kPeriodsAhead = 20.0;
constexpr double kWallClockMargin = 0.1;  // for planning and for braking [s]
constexpr double kGuardPeriods = 4.0;     // at the largest feedrate, more than Motion's guard wants
constexpr double kLargestMargin = 1.0;    // [s]

/// Gives the schedule's changes that are due at a time to the panel. @returns the next change
std::size_t apply_changes(const std::vector<OverrideChange>& schedule, std::size_t next, double t,
                          OperatorPanel& panel) noexcept {
  for (; next < schedule.size() && schedule[next].time <= t; ++next) {
    panel.set_override(schedule[next].percent);
  }
  return next;
}

}  // namespace

double first_override(const std::vector<OverrideChange>& schedule, OperatorPanel& panel) noexcept {
  apply_changes(schedule, 0, 0.0, panel);
  const double percent = panel.wish().percent;
  return percent > 0.0 ? percent : 100.0;
}

FeedControl::FeedControl(motion::Interpolator& interpolator, const PlanSupply& supply,
                         Replanning& replanning, OperatorPanel& panel, const Options& options)
    : interpolator_(interpolator),
      supply_(supply),
      replanning_(replanning),
      panel_(panel),
      options_(options),
      margin_(least_margin()) {
  records_.reserve(kMostRecords);
  apply_schedule(0.0);
  wish_ = panel_.wish();
  percent_ = options_.first_percent;
  if (!wish_.holds() && percent_ != 100.0) {
    record({.asked_at = 0.0, .percent = percent_, .from = 0.0});
  }
}

/// Gives the schedule's changes that are due to the panel.
void FeedControl::apply_schedule(double t) noexcept {
  next_change_ = apply_changes(options_.schedule, next_change_, t + 1e-6 * options_.period, panel_);
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

void FeedControl::update(double t) noexcept {
  apply_schedule(t);
  if (!interpolator_.has_started()) {
    return;
  }
  replanning_.report(interpolator_.place().segment);
  const OperatorPanel::Wish wish = wish_at(t);
  const bool holds = wish.holds();
  if (holds) {
    brake_for_hold(t);
  }
  follow_up(t, holds);
  if (state_ == State::kFollowing && !holds) {
    ask(wish.percent);
  }
  if (state_ == State::kAsked) {
    look_at_offer(holds);
    follow_up(t, holds);
  }
}

void FeedControl::brake_for_hold(double t) noexcept {
  if (!is_hold_) {
    record({.asked_at = wished_at_, .percent = 0.0, .from = t});
  }
  is_hold_ = true;
  interpolator_.brake(options_.ramp);
}

/// Asks for another plan where one is needed.
void FeedControl::ask(double percent) noexcept {
  const bool is_at_rest = interpolator_.is_at_rest();
  if (!is_at_rest && (interpolator_.is_braking() || percent == percent_)) {
    return;
  }
  if (rests_first_ && !is_at_rest) {
    interpolator_.brake(options_.ramp);
    return;
  }
  if (replanning_.ask({.from = interpolator_.place(),
                       .is_at_rest = is_at_rest,
                       .margin = margin_,
                       .percent = percent})) {
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
  const ReplanOffer* const offer = replanning_.offer();
  if (offer == nullptr) {
    return;
  }
  state_ = State::kFollowing;
  const bool still_suits = !holds && interpolator_.is_at_rest() == asked_at_rest_;
  const bool is_plan = offer->kind == ReplanOffer::Kind::kPlan;
  if (still_suits && is_plan && accept(*offer)) {
    state_ = asked_at_rest_ ? State::kPriming : State::kArmed;
    margin_ = least_margin();
    replanning_.answer(Verdict::kAccepted);
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
  replanning_.answer(Verdict::kRejected);
}

void FeedControl::decline() noexcept {
  if (state_ == State::kAsked && replanning_.offer() != nullptr) {
    replanning_.answer(Verdict::kRejected);
    state_ = State::kFollowing;
  }
}

/// Whether the plan that was taken is the one that is followed by now.
void FeedControl::follow_up(double t, bool holds) noexcept {
  const bool is_at_rest = interpolator_.is_at_rest();
  if (state_ == State::kArmed && interpolator_.plan() == interpolator_.latest_plan()) {
    percent_ = asked_percent_;
    record({.asked_at = wished_at_, .percent = percent_, .from = t});
    state_ = State::kFollowing;
  } else if (state_ == State::kArmed && is_at_rest) {
    state_ = State::kFollowing;  // braked before the place of the switch
  } else if (state_ == State::kPriming && !holds && supply_.is_primed()) {
    if (is_hold_ || percent_ != asked_percent_) {
      record({.asked_at = wished_at_, .percent = asked_percent_, .from = t});
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
  panel_.show({.state = state,
               .time = sample.t,
               .percent = percent_,
               .feedrate = sample.feedrate,
               .line = sample.line});
}

void FeedControl::show_end() noexcept {
  OperatorPanel::Display last = panel_.display();
  last.state = MotionState::kEnded;
  panel_.show(last);
}

}  // namespace twin::runtime

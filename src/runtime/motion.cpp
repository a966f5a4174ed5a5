#include "runtime/motion.hpp"

#include <algorithm>
#include <cmath>

namespace twin::runtime {
namespace {

/// Leaves the machine with 0 V and servo off, also when a hook throws.
class OffAtTheEnd {
 public:
  explicit OffAtTheEnd(Cycle& cycle) : cycle_(cycle) {}
  OffAtTheEnd(const OffAtTheEnd&) = delete;
  OffAtTheEnd& operator=(const OffAtTheEnd&) = delete;
  ~OffAtTheEnd() { cycle_.switch_off(); }

 private:
  Cycle& cycle_;
};

/// State of one run of the motion thread.
class Motion {
 public:
  Motion(Cycle& cycle, motion::Interpolator& interpolator, const PlanSupply& supply,
         SampleQueue& samples, Pace& pace, const MotionOptions& options,
         const std::atomic<bool>& stop)
      : cycle_(cycle),
        interpolator_(interpolator),
        supply_(supply),
        samples_(samples),
        pace_(pace),
        options_(options),
        ramp_{.acceleration = options.limits.acceleration, .jerk = options.limits.jerk},
        stop_(stop) {}

  MotionResult run();

 private:
  MotionEnd move();
  std::optional<MotionEnd> rest_before_path();
  std::optional<MotionEnd> follow_path();
  bool rest_after_path();
  bool begin_period();
  bool rest_one_period();
  bool exchange(results::Sample& sample);
  void guard_supply();
  double next_period(const feedrate::PathMotion& now) const;
  void record(const results::Sample& sample);
  void pass_over_missed();
  std::optional<MotionEnd> pass_idle();
  std::optional<MotionEnd> exchange_and_record();
  void trip(const motion::Trip& trip);
  void note_trip_of_cycle() {
    if (cycle_.trip()) {
      trip(*cycle_.trip());
    }
  }
  long periods_in(double time) const { return std::lround(time / options_.period); }
  bool is_switched_off() const { return trip_ && is_immediate(*trip_); }
  MotionEnd failed() const {
    return is_switched_off() ? MotionEnd::kTripped : MotionEnd::kMachineError;
  }
  MotionEnd at_rest() const;
  bool has_to_stop() const { return trip_ || met_at_ || stop_.load(std::memory_order_relaxed); }

  Cycle& cycle_;
  motion::Interpolator& interpolator_;
  const PlanSupply& supply_;
  SampleQueue& samples_;
  Pace& pace_;
  const MotionOptions& options_;
  feedrate::RampLimits ramp_;
  const std::atomic<bool>& stop_;
  std::optional<motion::Trip> trip_;
  std::optional<Vec2> met_at_;
  bool is_recording_ = true;
  motion::Status status_ = motion::Status::kMoving;  // of the last turn
};

/// @returns false if the machine failed
bool Motion::begin_period() {
  const hal::Status status = pace_.begin_period(cycle_);
  if (const auto overrun = pace_.overrun()) {
    trip(cycle_.stamped(*overrun));
  }
  return status == hal::Status::kOk;
}

/// Keeps the first trip, which is what is reported, but for one that switches the machine off.
void Motion::trip(const motion::Trip& trip) {
  if (!trip_ || (!is_immediate(*trip_) && is_immediate(trip))) {
    trip_ = trip;
  }
}

/// One period at rest. @returns false if the machine failed or was switched off
bool Motion::rest_one_period() {
  const bool is_fine = begin_period() && pace_.exchange_at_rest(cycle_) == hal::Status::kOk;
  note_trip_of_cycle();
  return is_fine;
}

/// Exchanges the set point of the period. @returns false if the machine failed or was switched off
bool Motion::exchange(results::Sample& sample) {
  const hal::Status status = pace_.exchange(cycle_, sample);
  note_trip_of_cycle();
  if (options_.until && !met_at_ && options_.until(cycle_.inputs())) {
    met_at_ = cycle_.measured();
  }
  return status == hal::Status::kOk;
}

MotionEnd Motion::at_rest() const {
  return trip_ ? MotionEnd::kTripped : stop_.load() ? MotionEnd::kInterrupted : MotionEnd::kDone;
}

/// Lets the loops come to rest before the path begins, and waits until the drives are ready.
std::optional<MotionEnd> Motion::rest_before_path() {
  if (!cycle_.has_machine()) {
    return std::nullopt;
  }
  const long least = periods_in(options_.rest_before);
  const long timeout = std::max(1L, periods_in(options_.ready_timeout));
  long last = least;
  bool is_ready = false;
  for (long i = 0; i < last || !is_ready; ++i) {
    if (!is_ready && i >= timeout) {
      trip(cycle_.stamped({.kind = motion::Kind::kNotReady,
                           .axis = cycle_.axis_not_ready(),
                           .value = static_cast<double>(i) * options_.period,
                           .limit = options_.ready_timeout}));
      return MotionEnd::kTripped;
    }
    if (!rest_one_period()) {
      return failed();
    }
    if (trip_ || (i >= least && stop_.load(std::memory_order_relaxed))) {
      return at_rest();
    }
    if (!is_ready && cycle_.is_ready()) {
      is_ready = true;
      last = i < least ? least : i + least;
    }
  }
  return std::nullopt;
}

/// Brakes when asked to stop, and while the known path still suffices for it.
void Motion::guard_supply() {
  if (has_to_stop()) {
    interpolator_.brake(ramp_);
    return;
  }
  const double reach = supply_.reach(interpolator_.latest_plan());
  if (!std::isfinite(reach) || !interpolator_.has_started()) {
    return;
  }
  const feedrate::PathMotion now = interpolator_.motion();
  if (now.v == 0.0 && supply_.is_primed()) {
    return;  // no more path will be known before it moves
  }
  const double known = reach - interpolator_.distance();
  if (interpolator_.braking_distance(ramp_) + next_period(now) > known) {
    interpolator_.brake(ramp_);
  }
}

/// How much more path braking can need a period later: with +J until then, the way of this period
/// and what the braking distance grows by, twice, since limits of single axes may be softer than
/// `ramp_`. At most what two periods of the largest feedrate are.
double Motion::next_period(const feedrate::PathMotion& now) const {
  const double t = options_.period;
  const feedrate::PathMotion from{0.0, now.v, now.a};
  const double rise =
      std::min(std::max(now.a, 0.0) * t + 0.5 * ramp_.jerk * t * t, ramp_.acceleration * t);
  const feedrate::PathMotion later{
      0.0, now.v + rise, std::min(std::max(now.a, 0.0) + ramp_.jerk * t, ramp_.acceleration)};
  const double grows =
      feedrate::make_brake(later, ramp_).distance - feedrate::make_brake(from, ramp_).distance;
  return std::min(2.0 * (later.v * t + grows), 2.0 * options_.limits.feedrate * t);
}

/// Hands a sample to the recorder. A full queue ends recording and motion where nothing waits.
void Motion::record(const results::Sample& sample) {
  while (is_recording_ && !samples_.push(sample)) {
    if (!pace_.wait_for_room(samples_)) {
      is_recording_ = false;
      trip(cycle_.stamped({.kind = motion::Kind::kSamplesLost}));
    }
  }
}

/// A period without a set point of the path.
std::optional<MotionEnd> Motion::pass_idle() {
  const bool is_fine = pace_.pass_idle(cycle_) == hal::Status::kOk;
  note_trip_of_cycle();
  return is_fine ? std::nullopt : std::optional(failed());
}

/// A recorded period: at a set point of the path, or at rest in a feed hold.
std::optional<MotionEnd> Motion::exchange_and_record() {
  results::Sample sample;
  const bool is_fine = exchange(sample);
  if (is_fine || is_switched_off()) {
    record(sample);
  }
  if (options_.feed != nullptr) {
    options_.feed->show(sample);
  }
  return is_fine ? std::nullopt : std::optional(failed());
}

/// Passes over the set points of missed periods, on a machine whose time passes by itself.
void Motion::pass_over_missed() {
  const int missed = pace_.wake_up().missed;
  for (int i = 1; i <= missed; ++i) {
    guard_supply();
    if (cycle_.prepare() != motion::Status::kMoving) {
      return;
    }
    results::Sample sample;
    cycle_.pass_over(sample, i / (missed + 1.0));
    record(sample);
  }
}

/// One turn of the loop; the end of the motion, or nothing.
std::optional<MotionEnd> Motion::follow_path() {
  if (!begin_period()) {
    return MotionEnd::kMachineError;
  }
  pass_over_missed();
  const bool may_start = pace_.wait_for_segment();
  if (!may_start && !interpolator_.has_started() && !has_to_stop()) {
    return pass_idle();
  }
  guard_supply();
  FeedControl* const feed = options_.feed;
  if (feed != nullptr && !has_to_stop()) {
    if (status_ == motion::Status::kStarved) {
      feed->decline();
    } else {
      feed->update(cycle_.time());
    }
  }
  status_ = cycle_.prepare();
  if (status_ == motion::Status::kDone) {
    return at_rest();
  }
  const bool is_at_rest = status_ == motion::Status::kAtRest;
  if (is_at_rest && (has_to_stop() || feed == nullptr)) {
    return at_rest();
  }
  if (status_ == motion::Status::kMoving || (is_at_rest && feed->is_hold())) {
    return exchange_and_record();
  }
  return pass_idle();
}

MotionEnd Motion::move() {
  auto end = rest_before_path();
  while (!end) {
    end = follow_path();
  }
  return *end;
}

/// Lets the table come to where the path ended. @returns false if the machine failed meanwhile
bool Motion::rest_after_path() {
  long periods = cycle_.has_machine() ? periods_in(options_.rest_after) : 0;
  while (periods > 0 && rest_one_period()) {
    --periods;
  }
  return periods == 0;
}

MotionResult Motion::run() {
  const OffAtTheEnd off(cycle_);
  MotionResult result;
  result.end = move();
  if (result.end == MotionEnd::kDone && !rest_after_path()) {
    result.end = failed();
  }
  result.trip = trip_;
  result.met_at = met_at_;
  result.rest_at = cycle_.measured();
  result.late_periods = pace_.late_periods();
  result.worst_latency = pace_.worst_latency();
  return result;
}

}  // namespace

MotionResult run_motion(Cycle& cycle, motion::Interpolator& interpolator, const PlanSupply& supply,
                        SampleQueue& samples, Pace& pace, const MotionOptions& options,
                        const std::atomic<bool>& stop) {
  return Motion(cycle, interpolator, supply, samples, pace, options, stop).run();
}

}  // namespace twin::runtime

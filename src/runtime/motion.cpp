#include "runtime/motion.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "runtime/nap.hpp"
#include "runtime/off_at_the_end.hpp"
#include "runtime/pacer.hpp"

namespace twin::runtime {
namespace {

/// State of one run of the motion thread.
class Motion {
 public:
  Motion(Cycle& cycle, motion::Interpolator& interpolator, SegmentQueue& segments,
         SampleQueue& samples, const Limits& limits, const Pace& pace,
         const std::atomic<bool>& stop)
      : cycle_(cycle),
        interpolator_(interpolator),
        segments_(segments),
        samples_(samples),
        ramp_{limits.acceleration, limits.jerk},
        limits_(limits),
        pace_(pace),
        stop_(stop),
        pacer_(pace.clock != nullptr ? *pace.clock : monotonic_, pace.period, pace.realtime,
               cycle.keeps_own_time() ? Schedule::kKept : Schedule::kShifted) {}

  MotionResult run();

 private:
  MotionEnd move();
  bool hold();
  std::optional<MotionEnd> settle();
  std::optional<MotionEnd> follow_path();
  bool begin_period();
  bool rest_one_period();
  bool exchange(results::Sample& sample);
  void guard_supply();
  void record(const results::Sample& sample);
  void pass_over_missed();
  std::optional<MotionEnd> wait_on_path();
  std::optional<MotionEnd> exchange_and_record();
  void trip(motion::Trip trip);
  void take_trip() {
    if (cycle_.trip()) {
      trip(*cycle_.trip());
    }
  }
  MotionEnd failed() const;
  MotionEnd at_rest() const;
  bool has_to_stop() const { return trip_ || met_at_ || stop_.load(std::memory_order_relaxed); }

  Cycle& cycle_;
  motion::Interpolator& interpolator_;
  SegmentQueue& segments_;
  SampleQueue& samples_;
  feedrate::RampLimits ramp_;
  Limits limits_;
  const Pace& pace_;
  const std::atomic<bool>& stop_;
  MonotonicClock monotonic_;
  Pacer pacer_;
  WakeUp wake_up_{};
  std::int64_t periods_ = 0;  // begun on the wall clock
  std::optional<motion::Trip> trip_;
  std::optional<Vec2> met_at_;
  bool is_recording_ = true;
  motion::Status status_ = motion::Status::kMoving;  // of the last turn
};

/// Wall clock: sleeps until the period begins and reads the machine at once.
bool Motion::begin_period() {
  wake_up_ = pacer_.wait();
  if (pace_.before_period) {
    pace_.before_period(periods_);
  }
  ++periods_;
  if (const auto overrun = pacer_.overrun()) {
    trip(cycle_.stamped(*overrun));
  }
  return cycle_.read(wake_up_.interval) == hal::Status::kOk;
}

/// The first trip is what is reported, but for one that the machine is switched off by.
void Motion::trip(motion::Trip trip) {
  if (!trip_ || (trip_->reaction == motion::Reaction::kControlled &&
                 trip.reaction == motion::Reaction::kImmediate)) {
    trip_ = trip;
  }
}

/// One period at rest. @returns false if the machine failed or was switched off
bool Motion::rest_one_period() {
  const bool is_fine = pace_.is_wall_clock
                           ? begin_period() && cycle_.respond_at_rest() == hal::Status::kOk
                           : cycle_.hold() == hal::Status::kOk;
  take_trip();
  return is_fine;
}

/// The period of a set point; on the wall clock it has begun already.
bool Motion::exchange(results::Sample& sample) {
  const hal::Status status = pace_.is_wall_clock ? cycle_.respond(sample) : cycle_.exchange(sample);
  take_trip();
  if (pace_.is_wall_clock) {
    sample.wake_up_latency = wake_up_.latency;
    sample.total_time = pacer_.since_deadline();
  }
  if (pace_.until && !met_at_ && pace_.until(cycle_.inputs())) {
    met_at_ = cycle_.measured();
  }
  return status == hal::Status::kOk;
}

MotionEnd Motion::failed() const {
  return trip_ && trip_->reaction == motion::Reaction::kImmediate ? MotionEnd::kTripped
                                                                  : MotionEnd::kMachineError;
}

MotionEnd Motion::at_rest() const {
  return trip_ ? MotionEnd::kTripped : stop_.load() ? MotionEnd::kInterrupted : MotionEnd::kDone;
}

/// Lets the loop settle at rest before the path begins, and waits until the drives are ready.
std::optional<MotionEnd> Motion::settle() {
  if (!cycle_.has_machine()) {
    return std::nullopt;
  }
  const auto in_periods = [&](double time) { return std::lround(time / pace_.period); };
  const long least = in_periods(pace_.settle_time);
  const long timeout = std::max(1L, in_periods(pace_.ready_timeout));
  long last = least;
  bool is_ready = false;
  for (long i = 0; i < last || !is_ready; ++i) {
    if (!is_ready && i >= timeout) {
      motion::Trip late{motion::Kind::kNotReady, cycle_.axis_not_ready()};
      late.value = static_cast<double>(i) * pace_.period;
      late.limit = pace_.ready_timeout;
      trip(cycle_.stamped(late));
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

/// Brakes when asked to stop; on the wall clock also while the known path still suffices for it.
void Motion::guard_supply() {
  if (has_to_stop()) {
    interpolator_.brake(ramp_);
    return;
  }
  const std::int64_t plan = interpolator_.latest_plan();
  if (!pace_.is_wall_clock || segments_.is_closed(plan)) {
    return;
  }
  const double known = segments_.reach(plan) - interpolator_.distance();
  const double next_period = 2.0 * limits_.feedrate * pace_.period;
  if (interpolator_.braking_distance(ramp_) + next_period > known) {
    interpolator_.brake(ramp_);
  }
}

/// Off the wall clock waits for room; on it a full queue ends recording and motion.
void Motion::record(const results::Sample& sample) {
  while (is_recording_ && !samples_.push(sample)) {
    if (!pace_.is_wall_clock) {
      nap();
      continue;
    }
    is_recording_ = false;
    trip(cycle_.stamped({motion::Kind::kSamplesLost, motion::kNoAxis, 0.0, 0.0, 0.0, 0,
                         motion::reaction_to(motion::Kind::kSamplesLost)}));
  }
}

/// A period without a set point of the path: at rest on the wall clock, where it has begun; a nap
/// off it.
std::optional<MotionEnd> Motion::wait_on_path() {
  if (!pace_.is_wall_clock) {
    nap();
    return std::nullopt;
  }
  const bool is_fine = cycle_.respond_at_rest() == hal::Status::kOk;
  take_trip();
  return is_fine ? std::nullopt : std::optional(failed());
}

/// A recorded period: at a set point of the path, or at rest in a feed hold.
std::optional<MotionEnd> Motion::exchange_and_record() {
  results::Sample sample;
  const bool is_fine = exchange(sample);
  if (is_fine || failed() == MotionEnd::kTripped) {
    record(sample);
  }
  if (pace_.feed != nullptr) {
    pace_.feed->show(sample);
  }
  return is_fine ? std::nullopt : std::optional(failed());
}

/// Passes over the set points of missed periods, on a machine whose time passes by itself.
void Motion::pass_over_missed() {
  const double pieces = wake_up_.missed + 1.0;
  for (int i = 1; i <= wake_up_.missed; ++i) {
    guard_supply();
    if (cycle_.prepare() != motion::Status::kMoving) {
      return;
    }
    results::Sample sample;
    cycle_.pass_over(sample, i / pieces);
    record(sample);
  }
}

/// One turn of the loop; the end of the motion, or nothing.
std::optional<MotionEnd> Motion::follow_path() {
  if (pace_.is_wall_clock) {
    if (!begin_period()) {
      return MotionEnd::kMachineError;
    }
    pass_over_missed();
  }
  if (pace_.is_wall_clock && !interpolator_.has_started() && !segments_.is_primed() &&
      !has_to_stop()) {
    return wait_on_path();
  }
  guard_supply();
  if (pace_.feed != nullptr && !has_to_stop() && status_ != motion::Status::kStarved) {
    pace_.feed->update(cycle_.time(), stop_);
  }
  status_ = cycle_.prepare();
  if (status_ == motion::Status::kDone) {
    return at_rest();
  }
  const bool is_at_rest = status_ == motion::Status::kAtRest;
  if (is_at_rest && (has_to_stop() || pace_.feed == nullptr)) {
    return at_rest();
  }
  if (status_ == motion::Status::kMoving || (is_at_rest && pace_.feed->is_hold())) {
    return exchange_and_record();
  }
  return wait_on_path();
}

MotionEnd Motion::move() {
  auto end = settle();
  while (!end) {
    end = follow_path();
  }
  return *end;
}

/// Lets the table come to where the path ended. @returns false if the machine failed meanwhile
bool Motion::hold() {
  auto periods = cycle_.has_machine() ? std::lround(pace_.hold_time / pace_.period) : 0;
  while (periods > 0 && rest_one_period()) {
    --periods;
  }
  return periods == 0;
}

MotionResult Motion::run() {
  const OffAtTheEnd off(cycle_);
  MotionResult result;
  result.end = move();
  if (result.end == MotionEnd::kDone && !hold()) {
    result.end = failed();
  }
  result.trip = trip_;
  result.met_at = met_at_;
  result.rest_at = cycle_.measured();
  result.late_periods = pacer_.late_periods();
  result.worst_latency = pacer_.worst_latency();
  return result;
}

}  // namespace

MotionResult run_motion(Cycle& cycle, motion::Interpolator& interpolator, SegmentQueue& segments,
                        SampleQueue& samples, const Limits& limits, const Pace& pace,
                        const std::atomic<bool>& stop) {
  return Motion(cycle, interpolator, segments, samples, limits, pace, stop).run();
}

}  // namespace twin::runtime

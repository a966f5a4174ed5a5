#include "runtime/motion.hpp"

#include <chrono>
#include <cmath>
#include <thread>

#include "runtime/pacer.hpp"

namespace twin::runtime {
namespace {

void nap() { std::this_thread::sleep_for(std::chrono::microseconds(20)); }

/// State of one run of the motion thread.
class Motion {
 public:
  Motion(Cycle& cycle, interpolator::Interpolator& interpolator, SegmentQueue& segments,
         SampleQueue& samples, const Limits& limits, const Pace& pace, bool has_machine,
         const std::atomic<bool>& stop)
      : cycle_(cycle),
        interpolator_(interpolator),
        segments_(segments),
        samples_(samples),
        ramp_{limits.acceleration, limits.jerk},
        limits_(limits),
        pace_(pace),
        has_machine_(has_machine),
        stop_(stop),
        pacer_(pace.period) {}

  MotionEnd run();

 private:
  bool settle();
  void guard_supply();
  bool record(const trace::Sample& sample);
  bool wait_on_path();

  Cycle& cycle_;
  interpolator::Interpolator& interpolator_;
  SegmentQueue& segments_;
  SampleQueue& samples_;
  feedrate::RampLimits ramp_;
  Limits limits_;
  Pace pace_;
  bool has_machine_;
  const std::atomic<bool>& stop_;
  Pacer pacer_;
};

/// Lets the loop settle at rest before the path begins.
bool Motion::settle() {
  const auto periods = has_machine_ ? std::lround(pace_.settle_time / pace_.period) : 0;
  for (long i = 0; i < periods; ++i) {
    if (cycle_.hold() != hal::Status::kOk) {
      return false;
    }
    if (pace_.is_wall_clock) {
      pacer_.wait();
    }
  }
  return true;
}

/// On the wall clock: brakes while the known path still suffices for it, or when asked to stop.
void Motion::guard_supply() {
  if (stop_.load(std::memory_order_relaxed)) {
    interpolator_.brake(ramp_);
    return;
  }
  if (!pace_.is_wall_clock || segments_.is_closed()) {
    return;
  }
  const double known = segments_.buffered_length() + interpolator_.remaining_in_segment();
  const double next_period = 2.0 * limits_.feedrate * pace_.period;
  if (interpolator_.braking_distance(ramp_) + next_period > known) {
    interpolator_.brake(ramp_);
  }
}

bool Motion::record(const trace::Sample& sample) {
  while (!samples_.push(sample)) {
    if (pace_.is_wall_clock) {
      return false;
    }
    nap();
  }
  return true;
}

/// One period (wall clock) or one nap without a set point of the path.
bool Motion::wait_on_path() {
  if (!pace_.is_wall_clock) {
    nap();
    return true;
  }
  const bool is_fine = !has_machine_ || cycle_.hold() == hal::Status::kOk;
  pacer_.wait();
  return is_fine;
}

MotionEnd Motion::run() {
  if (!settle()) {
    return MotionEnd::kMachineError;
  }
  trace::Sample sample;
  for (;;) {
    guard_supply();
    const interpolator::Status status = cycle_.prepare();
    if (status == interpolator::Status::kDone) {
      return stop_.load() ? MotionEnd::kInterrupted : MotionEnd::kDone;
    }
    if (status == interpolator::Status::kMoving) {
      if (cycle_.exchange(sample) != hal::Status::kOk) {
        return MotionEnd::kMachineError;
      }
      if (!record(sample)) {
        return MotionEnd::kOverrun;
      }
      if (pace_.is_wall_clock) {
        pacer_.wait();
      }
      continue;
    }
    if (status == interpolator::Status::kAtRest) {
      if (stop_.load()) {
        return MotionEnd::kInterrupted;
      }
      if (segments_.is_primed()) {
        interpolator_.resume();
      }
    }
    if (!wait_on_path()) {
      return MotionEnd::kMachineError;
    }
  }
}

}  // namespace

MotionEnd run_motion(Cycle& cycle, interpolator::Interpolator& interpolator, SegmentQueue& segments,
                     SampleQueue& samples, const Limits& limits, const Pace& pace, bool has_machine,
                     const std::atomic<bool>& stop) {
  return Motion(cycle, interpolator, segments, samples, limits, pace, has_machine, stop).run();
}

}  // namespace twin::runtime

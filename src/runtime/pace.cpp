#include "runtime/pace.hpp"

#include <algorithm>
#include <cmath>

namespace twin::runtime {

bool LockstepPace::wait_for_segment() noexcept {
  if (!planning_.plan_ahead()) {
    stop_.store(true);
  }
  return true;
}

bool LockstepPace::wait_for_room(SampleQueue& samples) noexcept {
  samples.wait_for_room();
  return true;
}

WallClockPace::WallClockPace(const PlanSupply& supply, Clock& clock, const Options& options)
    : supply_(supply),
      pacer_(clock, options.period, options.realtime, options.schedule),
      before_period_(options.before_period) {}

hal::Status WallClockPace::begin_period(Cycle& cycle) {
  begin(pacer_.wait());
  return cycle.read(wake_up_.interval);
}

void WallClockPace::begin(const WakeUp& wake_up) {
  wake_up_ = wake_up;
  if (before_period_) {
    before_period_(periods_);
  }
  ++periods_;
}

hal::Status WallClockPace::exchange(Cycle& cycle, results::Sample& sample) noexcept {
  const hal::Status status = cycle.respond(sample);
  sample.wake_up_latency = wake_up_.latency;
  sample.total_time = pacer_.since_deadline();
  return status;
}

BeatClock::BeatClock(double period) noexcept
    : period_(std::llround(period * static_cast<double>(kNsPerS))) {}

void BeatClock::beat(int periods) noexcept {
  passed_ += periods * period_;
  begun_ = monotonic_ns();
}

std::int64_t BeatClock::now() noexcept {
  // The next period is only there once the machine has counted it.
  return begun_ == 0 ? 0 : passed_ + std::min(monotonic_ns() - begun_, period_ - 1);
}

hal::Status BeatPace::begin_period(Cycle& cycle) {
  const hal::Status status = cycle.read_at_beat();
  clock_.beat(cycle.inputs().periods);
  begin(pacer().wait());
  return status;
}

}  // namespace twin::runtime

#include "runtime/pace.hpp"

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
  wake_up_ = pacer_.wait();
  if (before_period_) {
    before_period_(periods_);
  }
  ++periods_;
  return cycle.read(wake_up_.interval);
}

hal::Status WallClockPace::exchange(Cycle& cycle, results::Sample& sample) noexcept {
  const hal::Status status = cycle.respond(sample);
  sample.wake_up_latency = wake_up_.latency;
  sample.total_time = pacer_.since_deadline();
  return status;
}

}  // namespace twin::runtime

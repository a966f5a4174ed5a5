#include "runtime/run_options.hpp"

namespace twin::runtime {
namespace {

constexpr double kHoldTime = 0.1;  // at the path's end, before the machine is switched off [s]

}  // namespace

gcode::ReaderOptions reader_options(const RunRequest& request) {
  return {.feedrate = request.feedrate};
}

FeedControl::Options feed_options(const RunRequest& request) {
  const Limits& limits = request.machine.limits;
  return {.schedule = request.overrides,
          .ramp = {limits.acceleration, limits.jerk},
          .period = request.machine.period,
          .is_wall_clock = request.is_wall_clock,
          .feedrate = limits.feedrate};
}

Pace pace_of(const RunRequest& request) {
  Pace pace;
  pace.is_wall_clock = request.is_wall_clock;
  pace.period = request.machine.period;
  pace.ready_timeout = request.machine.safety.ready_timeout;
  pace.realtime = request.machine.realtime;
  pace.before_period = request.hooks.before_period;
  pace.until = request.until;
  pace.hold_time = kHoldTime;
  return pace;
}

Recorder::Options recorder_options(const RunRequest& request) {
  return {.directory = request.directory,
          .sinks = request.sinks,
          .program = request.program,
          .reader = reader_options(request),
          .limits = request.machine.limits,
          .period = request.machine.period,
          .has_machine = request.hal != nullptr,
          .is_wall_clock = request.is_wall_clock};
}

}  // namespace twin::runtime

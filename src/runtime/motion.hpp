#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/limits.hpp"
#include "core/realtime_settings.hpp"
#include "core/vec.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "results/trace/sample.hpp"
#include "runtime/clock.hpp"
#include "runtime/cycle.hpp"
#include "runtime/feed_control.hpp"
#include "runtime/hooks.hpp"
#include "runtime/segment_queue.hpp"

namespace twin::runtime {

/// The bounded buffer of samples between motion thread and recorder.
using SampleQueue = boost::lockfree::spsc_queue<results::Sample>;

/// How a motion ended.
enum class MotionEnd : std::uint8_t {
  kDone,          ///< the whole path
  kInterrupted,   ///< braked to rest because stop was asked for
  kMachineError,  ///< the machine is no longer under control
  kTripped,       ///< a monitor ended it
};

/// What is known of a motion after its end.
struct MotionResult {
  MotionEnd end = MotionEnd::kDone;
  std::optional<motion::Trip> trip;  ///< what ended it, with kTripped
  Vec2 rest_at = Vec2::Zero();       ///< measured at its end [mm]
  std::optional<Vec2> met_at;        ///< measured, where Pace::until came true [mm]
  std::int64_t late_periods = 0;     ///< wall clock only
  double worst_latency = 0.0;        ///< of a period's begin [s]; wall clock only
};

/// How the motion thread keeps time.
struct Pace {
  bool is_wall_clock =
      false;  ///< one period of the cycle per period of the wall clock; else as fast as it goes
  double period = 0.001;        ///< [s]
  double settle_time = 0.3;     ///< held at rest before the first set point, with a machine [s]
  double hold_time = 0.0;       ///< held at rest after the path's end, not recorded [s]
  double ready_timeout = 3.0;   ///< within which the drives must be ready [s]
  RealtimeSettings realtime;    ///< when a period is too late
  Clock* clock = nullptr;       ///< null: CLOCK_MONOTONIC
  FeedControl* feed = nullptr;  ///< override and hold; null: a path that was braked ends there
  std::function<void(std::int64_t)> before_period;  ///< see Hooks
  Until until;                                      ///< ends the motion early
};

/// Runs cycles from rest to rest; the body of the motion thread. At its end the machine is off, 0 V
/// and servo off, whatever the reason.
///
/// The path begins after settle_time at rest, and not before both drives are ready.
///
/// Off the wall clock it waits for segments and for room in the sample queue, so the result does
/// not depend on threads' timing. On the wall clock it waits for nothing: a planner that falls
/// behind makes it brake on the path before the known part ends, and go on by another plan when the
/// buffer has filled again. A feed hold is a part of the motion: its periods are recorded. Late
/// periods and a full sample queue make it brake on the path and end.
///
/// @param stop  set from outside (Ctrl-C): brake on the path and end
MotionResult run_motion(Cycle& cycle, motion::Interpolator& interpolator, SegmentQueue& segments,
                        SampleQueue& samples, const Limits& limits, const Pace& pace,
                        const std::atomic<bool>& stop);

}  // namespace twin::runtime

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "hal/machine.hpp"
#include "motion/safety/trip.hpp"
#include "runtime/cycle.hpp"
#include "runtime/feed_control.hpp"
#include "runtime/pace.hpp"
#include "runtime/replanning.hpp"
#include "runtime/sample_queue.hpp"

namespace twin::runtime {

/// A condition that ends the motion, evaluated in the motion thread after every set point. As soon
/// as it returns true the machine brakes on the path, and the motion ends as at the path's end.
/// Real-time safe.
using Until = std::function<bool(const hal::Inputs&)>;

/// How a motion ended.
enum class MotionEnd : std::uint8_t {
  kDone,          ///< the whole path
  kInterrupted,   ///< braked to rest because stop was asked for
  kMachineError,  ///< the machine is no longer under control
  kTripped,       ///< a monitor ended it
};

/// How a motion went.
struct MotionResult {
  MotionEnd end = MotionEnd::kDone;
  std::optional<motion::Trip> trip;  ///< what ended the motion, if end is kTripped
  Vec2 rest_at = Vec2::Zero();       ///< measured at the end of the motion [mm]
  std::optional<Vec2> met_at;        ///< measured where MotionOptions::until came true [mm]
  std::int64_t late_periods = 0;     ///< periods that began too late; 0 in lockstep
  double worst_latency = 0.0;        ///< latest begin of a period [s]; 0 in lockstep
};

/// Options of a motion.
struct MotionOptions {
  double period = 0.001;        ///< interpolation period T [s]
  double rest_before = 0.3;     ///< time at rest before the first set point, with a machine [s]
  double rest_after = 0.0;      ///< time at rest after the path's end, not recorded [s]
  double ready_timeout = 3.0;   ///< time within which the drives must be ready [s]
  Limits limits;                ///< acceleration and jerk of braking
  FeedControl* feed = nullptr;  ///< override and hold; null: braking to rest ends the motion
  Until until{};                ///< ends the motion early; empty: never
};

/// Runs one cycle after the other from rest to rest: the body of the motion thread. However the
/// motion ends, the machine is switched off then (0 V, servo off).
///
/// The path begins after rest_before, and not before both drives are ready.
///
/// In lockstep the motion waits for segments and for room in the sample queue, so the result does
/// not depend on the timing of threads. On the wall clock it waits for nothing. If planning falls
/// behind, the motion brakes on the path before the planned part ends, and goes on by another plan
/// once the buffer has filled again. A feed hold is a part of the motion, and its periods are
/// recorded. If too many periods are late or the sample queue is full, the motion brakes on the
/// path and ends.
///
/// @param stop  set from outside (Ctrl-C): brake on the path and end
MotionResult run_motion(Cycle& cycle, motion::Interpolator& interpolator, const PlanSupply& supply,
                        SampleQueue& samples, Pace& pace, const MotionOptions& options,
                        const std::atomic<bool>& stop);

}  // namespace twin::runtime

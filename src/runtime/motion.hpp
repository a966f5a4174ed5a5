#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstdint>

#include "core/limits.hpp"
#include "hal/machine.hpp"
#include "runtime/cycle.hpp"
#include "runtime/segment_queue.hpp"
#include "trace/sample.hpp"

namespace twin::runtime {

/// The bounded buffer of samples between motion thread and recorder.
using SampleQueue = boost::lockfree::spsc_queue<trace::Sample>;

/// How a motion ended.
enum class MotionEnd : std::uint8_t {
  kDone,          ///< the whole path
  kInterrupted,   ///< braked to rest because stop was asked for
  kMachineError,  ///< the machine is no longer under control
  kOverrun,       ///< samples could not be recorded as fast as they came (wall clock only)
};

/// How the motion thread keeps time.
struct Pace {
  bool is_wall_clock =
      false;  ///< one period of the cycle per period of the wall clock; else as fast as it goes
  double period = 0.001;     ///< [s]
  double settle_time = 0.3;  ///< held at rest before the first set point, with a machine [s]
};

/// Runs cycles from rest to rest; the body of the motion thread.
///
/// Off the wall clock it waits for segments and for room in the sample queue, so the result does
/// not depend on threads' timing. On the wall clock it waits for nothing: a planner that falls
/// behind makes it brake on the path before the known part ends, and go on when the buffer has
/// filled again.
///
/// @param stop  set from outside (Ctrl-C): brake on the path and end
MotionEnd run_motion(Cycle& cycle, interpolator::Interpolator& interpolator, SegmentQueue& segments,
                     SampleQueue& samples, const Limits& limits, const Pace& pace, bool has_machine,
                     const std::atomic<bool>& stop);

}  // namespace twin::runtime

#pragma once

#include <cstdint>
#include <deque>

#include "config/machine_file.hpp"
#include "feedrate/look_ahead.hpp"
#include "feedrate/planned_segment.hpp"
#include "runtime/switch_place.hpp"

namespace twin::runtime {

/// Where a plan starts, and how fast the path is wanted.
struct PlanStart {
  std::int64_t number = 0;   ///< of the plan
  std::int64_t lead_in = 0;  ///< index of the first segment that is pushed
  std::int64_t segment = 0;  ///< in which the plan starts
  double s = 0.0;            ///< from the lead-in's start [mm]
  double v = 0.0;            ///< [mm/s]
  double percent = 100.0;    ///< of the programmed feedrates [%]
};

/// What a plan keeps of the segments that have left it.
enum class Remembers : std::uint8_t {
  kNothing,
  kPhases,  ///< their phases, so that another plan may take over
};

/// One plan of the rest of the path: a look-ahead of its own, and what it has planned.
class PlanVersion {
 public:
  PlanVersion(const config::MachineFile& machine, const PlanStart& start, Remembers remembers);
  PlanVersion(const PlanVersion&) = delete;
  PlanVersion& operator=(const PlanVersion&) = delete;
  ~PlanVersion() = default;

  void push(path::Segment&& segment) { look_ahead_.push(std::move(segment)); }
  void finish() { look_ahead_.finish(); }
  /// The motion has come to this segment.
  void drop_before(std::int64_t segment);

  std::int64_t number() const noexcept { return start_.number; }
  /// Segments that are planned and wait to be followed.
  std::deque<feedrate::PlannedSegment>& ready() noexcept { return ready_; }
  const std::deque<SegmentPhases>& phases() const noexcept { return phases_; }
  std::int64_t fallbacks() const noexcept { return look_ahead_.fallbacks(); }
  double time() const noexcept { return time_; }

 private:
  void append(feedrate::PlannedSegment&& planned);

  PlanStart start_;
  Remembers remembers_;
  double time_ = 0.0;  // of what has been planned [s]
  std::deque<feedrate::PlannedSegment> ready_;
  std::deque<SegmentPhases> phases_;
  feedrate::LookAhead look_ahead_;
};

}  // namespace twin::runtime

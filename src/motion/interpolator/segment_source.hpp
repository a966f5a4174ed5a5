#pragma once

#include <cstdint>

#include "feedrate/planned_segment.hpp"

namespace twin::motion {

/// Where the interpolator gets its segments from; called in the cycle. Real-time safe on the wall
/// clock.
class SegmentSource {
 public:
  SegmentSource() = default;
  SegmentSource(const SegmentSource&) = delete;
  SegmentSource& operator=(const SegmentSource&) = delete;
  virtual ~SegmentSource() = default;

  /// Next segment, or null when none is there yet or none will follow.
  virtual const feedrate::PlannedSegment* next() noexcept = 0;
  /// Releases a segment that next() handed out; the first one first.
  virtual void release(const feedrate::PlannedSegment* segment) noexcept = 0;
  /// Whether next() has handed out the last one.
  virtual bool is_finished() const noexcept = 0;
  /// From now on next() hands out segments of this plan.
  virtual void adopt(std::int64_t /*plan*/) noexcept {}
};

}  // namespace twin::motion

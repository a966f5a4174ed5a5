#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <vector>

#include "feedrate/planned_segment.hpp"
#include "interpolator/interpolator.hpp"

namespace twin::runtime {

/// The bounded buffer of planned segments between planning thread and motion thread.
///
/// A fixed number of segments goes round: the planning thread takes a free one, fills it
/// (allocating as it must) and pushes it; the motion thread pops it, follows it, and gives it back.
/// So the motion thread neither allocates nor frees, and a planner that is far ahead waits.
class SegmentQueue final : public interpolator::SegmentSource {
 public:
  explicit SegmentQueue(std::size_t capacity);

  // Planning thread.

  /// Hands a segment over; waits while the buffer is full. @returns false if the motion was stopped
  /// meanwhile
  bool push(feedrate::PlannedSegment&& segment);
  /// No more segments follow.
  void close() noexcept { is_closed_.store(true, std::memory_order_release); }

  // Motion thread; real-time safe.

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* segment) noexcept override;
  bool is_finished() const noexcept override;
  /// Length of the segments that wait in the buffer [mm].
  double buffered_length() const noexcept;
  bool is_closed() const noexcept { return is_closed_.load(std::memory_order_acquire); }

  // Any thread.

  /// Nothing is wanted any more: a planner that waits gives up.
  void stop() noexcept { is_stopped_.store(true, std::memory_order_release); }
  bool is_stopped() const noexcept { return is_stopped_.load(std::memory_order_acquire); }
  /// Whether the buffer is full or complete, so that motion may start.
  bool is_primed() const noexcept;

 private:
  using Ring = boost::lockfree::spsc_queue<feedrate::PlannedSegment*>;

  std::vector<feedrate::PlannedSegment> pool_;
  Ring planned_;
  Ring free_;
  std::atomic<double> pushed_length_{0.0};
  double popped_length_ = 0.0;  // motion thread only
  std::atomic<bool> is_closed_{false};
  std::atomic<bool> is_stopped_{false};
};

}  // namespace twin::runtime

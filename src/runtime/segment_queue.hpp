#pragma once

#include <array>
#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "feedrate/planned_segment.hpp"
#include "runtime/replanning.hpp"

namespace twin::runtime {

/// The bounded buffer of planned segments between planning thread and motion thread.
///
/// It serves a motion on the wall clock. A fixed number of segments goes round: the planning thread
/// fills a free one (allocating as it must) and queues it; the motion thread dequeues it, follows
/// it, and releases it. So the motion thread neither allocates nor frees memory, and a planner that
/// is far ahead waits.
///
/// Where another plan takes over, its segments come after those of the plan before, and adopt()
/// passes over what is left of that one. How far a plan reaches is known for the two latest ones.
class SegmentQueue final : public PlanSupply {
 public:
  /// @param capacity  segments of a plan that wait in it
  /// @param spare     room for those of the next plan while they do
  explicit SegmentQueue(std::size_t capacity, std::size_t spare = 0);

  // Planning thread.

  /// Queues a segment; waits while the buffer is full. @returns false if the motion was stopped
  /// meanwhile
  bool push(feedrate::PlannedSegment&& segment);
  /// Queues a segment. @param reach  see set_reach()
  /// @returns false, with nothing done, if the buffer is full
  bool try_push(feedrate::PlannedSegment& segment, std::int64_t plan, double reach);
  /// The latest plan is known up to a distance from the path's start [mm].
  void set_reach(std::int64_t plan, double reach) noexcept {
    reach_[plan & 1].store(reach, std::memory_order_release);
  }
  static constexpr std::int64_t kEveryPlan = -2;  ///< for close()
  /// No more segments of a plan follow.
  void close(std::int64_t plan = 0) noexcept { closed_.store(plan, std::memory_order_release); }

  // Motion thread; real-time safe.

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* segment) noexcept override;
  bool is_finished() const noexcept override;
  void adopt(std::int64_t plan) noexcept override;
  /// Infinite where all of the plan has been queued.
  double reach(std::int64_t plan) const noexcept override;
  /// Whether the buffer is full, or holds all of the plan that is followed.
  bool is_primed() const noexcept override;

  // Any thread.

  /// Nothing is wanted any more: a planner that waits gives up.
  void stop() noexcept { is_stopped_.store(true, std::memory_order_release); }
  bool is_stopped() const noexcept { return is_stopped_.load(std::memory_order_acquire); }

 private:
  /// Whether all of a plan has been queued.
  bool is_closed(std::int64_t plan) const noexcept {
    const std::int64_t closed = closed_.load(std::memory_order_acquire);
    return closed == plan || closed == kEveryPlan;
  }

  using Ring = boost::lockfree::spsc_queue<feedrate::PlannedSegment*>;

  std::size_t capacity_;
  std::vector<feedrate::PlannedSegment> pool_;
  Ring planned_;
  Ring free_;
  const feedrate::PlannedSegment* ahead_ = nullptr;  // motion thread: first of a plan adopted
  std::int64_t plan_ = 0;                            // motion thread: the one that is followed
  std::array<std::atomic<double>, 2> reach_{};       // of plans with even and odd numbers [mm]
  std::atomic<std::int64_t> closed_{-1};
  std::atomic<bool> is_stopped_{false};
};

}  // namespace twin::runtime

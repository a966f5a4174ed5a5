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

/// Bounded buffer of planned segments between planning thread and motion thread, for a motion on
/// the wall clock.
///
///                 .---- planned: push ----> next ----.
///   planning thread                                  motion thread
///                 '---- free: reused <--- release ---'
///
/// A fixed number of segments circulates. The planning thread fills a free one, allocating memory
/// as needed, and queues it; the motion thread takes it, follows it and releases it. So the motion
/// thread neither allocates nor frees memory, and a planner that is far ahead waits.
///
/// If another plan takes over, its segments follow those of the plan before in the same buffer, and
/// adopt() skips what is left of the plan before. reach() is known for the two latest plans.
class SegmentQueue final : public PlanSupply {
 public:
  /// @param capacity  number of segments of one plan that may wait in the buffer
  /// @param spare     further segments, for the next plan while the buffer is full
  explicit SegmentQueue(std::size_t capacity, std::size_t spare = 0);

  // Planning thread.

  /// Queues a segment; waits while the buffer is full.
  /// @returns false if stop() was called meanwhile
  bool push(feedrate::PlannedSegment&& segment);
  /// Queues a segment of a plan, and sets the plan's reach.
  /// @param reach  see set_reach()
  /// @returns false, with nothing done, if the buffer is full
  bool try_push(feedrate::PlannedSegment& segment, std::int64_t plan, double reach);
  /// Sets how far the latest plan is known.
  /// @param reach  distance from the start of the path [mm]
  void set_reach(std::int64_t plan, double reach) noexcept {
    reach_[plan & 1].store(reach, std::memory_order_release);
  }
  static constexpr std::int64_t kEveryPlan = -2;  ///< argument of close(): no plan goes on
  /// Says that no more segments of a plan follow.
  void close(std::int64_t plan = 0) noexcept { closed_.store(plan, std::memory_order_release); }

  // Motion thread; real-time safe.

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* segment) noexcept override;
  bool is_finished() const noexcept override;
  void adopt(std::int64_t plan) noexcept override;
  /// Distance from the start of the path up to which a plan is known [mm]; infinite once all of its
  /// segments have been queued.
  double reach(std::int64_t plan) const noexcept override;
  /// Whether the motion may start: the buffer is full or holds the whole plan that is followed.
  bool is_primed() const noexcept override;

  // Any thread.

  /// Says that no segment is wanted any more; a waiting push() returns.
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
  const feedrate::PlannedSegment* ahead_ = nullptr;  // motion thread: first one of an adopted plan
  std::int64_t plan_ = 0;                            // motion thread: plan that is followed
  std::array<std::atomic<double>, 2> reach_{};       // of plans with even and odd numbers [mm]
  std::atomic<std::int64_t> closed_{-1};
  std::atomic<bool> is_stopped_{false};
};

}  // namespace twin::runtime

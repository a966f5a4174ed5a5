#include "runtime/segment_queue.hpp"

#include <limits>
#include <utility>

#include "runtime/nap.hpp"

namespace twin::runtime {

SegmentQueue::SegmentQueue(std::size_t capacity, std::size_t spare)
    : capacity_(capacity),
      pool_(capacity + 1 + spare),
      planned_(pool_.size()),
      free_(pool_.size()) {
  for (feedrate::PlannedSegment& segment : pool_) {
    free_.push(&segment);
  }
}

bool SegmentQueue::try_push(feedrate::PlannedSegment& segment, std::int64_t plan, double reach) {
  feedrate::PlannedSegment* slot = nullptr;
  if (!free_.pop(slot)) {
    return false;
  }
  *slot = std::move(segment);
  planned_.push(slot);
  set_reach(plan, reach);
  return true;
}

bool SegmentQueue::push(feedrate::PlannedSegment&& segment) {
  const std::int64_t plan = segment.plan;
  const double end = reach_[plan & 1].load() + segment.segment.length;
  while (!try_push(segment, plan, end)) {
    if (is_stopped()) {
      return false;
    }
    nap();
  }
  return !is_stopped();
}

const feedrate::PlannedSegment* SegmentQueue::next() noexcept {
  if (ahead_ != nullptr) {
    return std::exchange(ahead_, nullptr);
  }
  feedrate::PlannedSegment* segment = nullptr;
  while (planned_.pop(segment)) {
    if (segment->plan == plan_) {
      return segment;
    }
    release(segment);
  }
  return nullptr;
}

void SegmentQueue::adopt(std::int64_t plan) noexcept {
  if (ahead_ != nullptr) {
    release(std::exchange(ahead_, nullptr));
  }
  plan_ = plan;
  ahead_ = next();
}

void SegmentQueue::release(const feedrate::PlannedSegment* segment) noexcept {
  free_.push(&pool_[static_cast<std::size_t>(segment - pool_.data())]);
}

bool SegmentQueue::is_finished() const noexcept {
  return is_closed(plan_) && ahead_ == nullptr && planned_.read_available() == 0;
}

double SegmentQueue::reach(std::int64_t plan) const noexcept {
  return is_closed(plan) ? std::numeric_limits<double>::infinity()
                         : reach_[plan & 1].load(std::memory_order_acquire);
}

bool SegmentQueue::is_primed() const noexcept {
  const std::size_t waiting = planned_.read_available() + (ahead_ != nullptr ? 1 : 0);
  return is_closed(plan_) || waiting >= capacity_;
}

}  // namespace twin::runtime

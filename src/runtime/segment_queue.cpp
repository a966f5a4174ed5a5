#include "runtime/segment_queue.hpp"

#include <chrono>
#include <thread>
#include <utility>

namespace twin::runtime {

SegmentQueue::SegmentQueue(std::size_t capacity)
    : pool_(capacity + 1), planned_(pool_.size()), free_(pool_.size()) {
  for (feedrate::PlannedSegment& segment : pool_) {
    free_.push(&segment);
  }
}

bool SegmentQueue::push(feedrate::PlannedSegment&& segment) {
  feedrate::PlannedSegment* slot = nullptr;
  while (!free_.pop(slot)) {
    if (is_stopped()) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  *slot = std::move(segment);
  const double length = slot->segment.length;
  planned_.push(slot);
  pushed_length_.store(pushed_length_.load(std::memory_order_relaxed) + length,
                       std::memory_order_release);
  return !is_stopped();
}

const feedrate::PlannedSegment* SegmentQueue::next() noexcept {
  feedrate::PlannedSegment* segment = nullptr;
  if (!planned_.pop(segment)) {
    return nullptr;
  }
  popped_length_ += segment->segment.length;
  return segment;
}

void SegmentQueue::release(const feedrate::PlannedSegment* segment) noexcept {
  free_.push(&pool_[static_cast<std::size_t>(segment - pool_.data())]);
}

bool SegmentQueue::is_finished() const noexcept {
  return is_closed() && planned_.read_available() == 0;
}

double SegmentQueue::buffered_length() const noexcept {
  return pushed_length_.load(std::memory_order_acquire) - popped_length_;
}

bool SegmentQueue::is_primed() const noexcept {
  return is_closed() || planned_.write_available() <= 1;
}

}  // namespace twin::runtime

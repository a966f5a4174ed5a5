#include "runtime/sample_queue.hpp"

#include "runtime/nap.hpp"

namespace twin::runtime {
namespace {

constexpr std::uint32_t kSamplesAWakeUp = 64;

}  // namespace

bool SampleQueue::push(const results::Sample& sample) noexcept {
  if (!queue_.push(sample)) {
    return false;
  }
  if (waiting_ == Waiting::kAwake && ++unseen_ >= kSamplesAWakeUp) {
    show_samples();
  }
  return true;
}

void SampleQueue::show_samples() noexcept {
  unseen_ = 0;
  samples_shown_.fetch_add(1, std::memory_order_release);
  samples_shown_.notify_one();
}

void SampleQueue::wait_for_room() noexcept {
  const std::uint32_t seen = room_shown_.load(std::memory_order_acquire);
  if (queue_.write_available() == 0) {
    show_samples();
    room_shown_.wait(seen, std::memory_order_acquire);
  }
}

void SampleQueue::close() noexcept {
  is_closed_.store(true, std::memory_order_release);
  show_samples();
}

void SampleQueue::show_room() noexcept {
  if (waiting_ == Waiting::kAwake) {
    room_shown_.fetch_add(1, std::memory_order_release);
    room_shown_.notify_one();
  }
}

bool SampleQueue::wait_for_samples() noexcept {
  const std::uint32_t seen = samples_shown_.load(std::memory_order_acquire);
  const bool is_closed = is_closed_.load(std::memory_order_acquire);
  if (queue_.read_available() > 0) {
    return true;
  }
  if (is_closed) {
    return false;
  }
  if (waiting_ == Waiting::kAwake) {
    samples_shown_.wait(seen, std::memory_order_acquire);
  } else {
    nap();
  }
  return true;
}

}  // namespace twin::runtime

#pragma once

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cstddef>
#include <cstdint>

#include "results/trace/sample.hpp"

namespace twin::runtime {

/// The bounded buffer of samples between the motion thread and the recorder.
class SampleQueue {
 public:
  /// How the two threads learn of each other.
  enum class Waiting : std::uint8_t {
    kAwake,  ///< in lockstep: each wakes the other one
    kPoll,   ///< on the wall clock: the motion thread wakes nobody, the recorder looks again
  };

  explicit SampleQueue(std::size_t capacity, Waiting waiting = Waiting::kPoll)
      : queue_(capacity), waiting_(waiting) {}

  // Motion thread.

  /// @returns false if the queue is full. Real-time safe with Waiting::kPoll.
  bool push(const results::Sample& sample) noexcept;
  /// Waits while the queue is full; with Waiting::kAwake only.
  void wait_for_room() noexcept;
  /// No more samples follow.
  void close() noexcept;

  // Recorder.

  /// @returns false if the queue is empty
  bool pop(results::Sample& sample) noexcept { return queue_.pop(sample); }
  /// The samples popped so far have made room.
  void show_room() noexcept;
  /// Waits until there are samples, or for a moment. @returns false if none will follow
  bool wait_for_samples() noexcept;

  std::size_t size() const noexcept { return queue_.read_available(); }
  /// Empties it, while no other thread uses it.
  void reset() noexcept { queue_.reset(); }

 private:
  void show_samples() noexcept;

  boost::lockfree::spsc_queue<results::Sample> queue_;
  Waiting waiting_;
  std::uint32_t unseen_ = 0;                     // motion thread: pushed since it woke the recorder
  std::atomic<std::uint32_t> samples_shown_{0};  // grows when the recorder is to look
  std::atomic<std::uint32_t> room_shown_{0};     // grows when the motion thread is to look
  std::atomic<bool> is_closed_{false};
};

}  // namespace twin::runtime

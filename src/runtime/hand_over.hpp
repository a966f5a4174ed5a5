#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

namespace twin::runtime {

/// Hands things over from one thread to another, in order and in batches.
///
/// No more than `most` batches wait: the thread that gives waits until there is room, and the one
/// that takes until there is something. So memory is bounded, however unlike the threads' paces are,
/// and the lock is taken once a batch.
template <class T>
class HandOver {
 public:
  /// @param batch  things handed over at once, >= 1
  /// @param most   batches that may wait, >= 1
  HandOver(std::size_t batch, std::size_t most) : batch_(batch), most_(most) {}
  HandOver(const HandOver&) = delete;
  HandOver& operator=(const HandOver&) = delete;
  ~HandOver() = default;

  /// Gives the next thing. @returns false, and nothing is given, if the other side has stopped
  bool push(T&& thing) {
    open_.push_back(std::move(thing));
    return open_.size() < batch_ || flush();
  }

  /// Nothing more is given.
  void close() {
    flush();
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
    given_.notify_one();
  }

  /// Takes the next thing, which stays where it is until the next call; null at the end.
  T* next() { return next_ < taken_.size() || take() ? &taken_[next_++] : nullptr; }

  /// Nothing more is taken: the side that gives need not go on.
  void stop() {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    taken_away_.notify_one();
  }

 private:
  bool flush() {
    std::unique_lock lock(mutex_);
    taken_away_.wait(lock, [this] { return waiting_.size() < most_ || is_stopped_; });
    if (is_stopped_) {
      open_.clear();
      return false;
    }
    if (!open_.empty()) {
      waiting_.push_back(std::move(open_));
      open_ = std::exchange(spare_, {});
      given_.notify_one();
    }
    return true;
  }

  bool take() {
    taken_.clear();
    next_ = 0;
    std::unique_lock lock(mutex_);
    given_.wait(lock, [this] { return !waiting_.empty() || is_closed_; });
    if (waiting_.empty()) {
      return false;
    }
    spare_ = std::move(taken_);
    taken_ = std::move(waiting_.front());
    waiting_.pop_front();
    taken_away_.notify_one();
    return true;
  }

  std::size_t batch_;
  std::size_t most_;
  std::vector<T> open_;   // of the thread that gives
  std::vector<T> taken_;  // of the thread that takes
  std::size_t next_ = 0;  // of taken_

  std::mutex mutex_;  // protects the members that follow
  std::condition_variable given_;
  std::condition_variable taken_away_;
  std::deque<std::vector<T>> waiting_;
  std::vector<T> spare_;  // a batch that was taken, whose memory is used again
  bool is_closed_ = false;
  bool is_stopped_ = false;
};

}  // namespace twin::runtime

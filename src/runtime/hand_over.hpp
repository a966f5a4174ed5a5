#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/bounded_queue.hpp"

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
  HandOver(std::size_t batch, std::size_t most) : batch_(batch), batches_(most) {}

  /// Gives the next thing. @returns false, and nothing is given, if the other side has stopped
  bool push(T&& thing) {
    open_.push_back(std::move(thing));
    return open_.size() < batch_ || flush();
  }

  /// Nothing more is given.
  void close() {
    flush();
    batches_.close();
  }

  /// Takes the next thing, which stays where it is until the next call; null at the end.
  T* next() { return next_ < taken_.size() || take() ? &taken_[next_++] : nullptr; }

  /// Nothing more is taken: the side that gives need not go on.
  void stop() { batches_.close(); }

 private:
  bool flush() {
    std::vector<T> batch = std::exchange(open_, {});
    open_.reserve(batch_);
    return batch.empty() || batches_.push(std::move(batch));
  }

  bool take() {
    next_ = 0;
    taken_ = batches_.pop().value_or(std::vector<T>());
    return !taken_.empty();
  }

  std::size_t batch_;
  BoundedQueue<std::vector<T>> batches_;
  std::vector<T> open_;   // of the thread that gives
  std::vector<T> taken_;  // of the thread that takes
  std::size_t next_ = 0;  // of taken_
};

}  // namespace twin::runtime

#pragma once

#include <chrono>
#include <thread>

namespace twin::runtime {

/// Wakes up at the multiples of a period on the monotonic clock.
class Pacer {
 public:
  /// @param period  [s]
  explicit Pacer(double period)
      : period_(std::chrono::duration_cast<std::chrono::nanoseconds>(
            std::chrono::duration<double>(period))),
        next_(std::chrono::steady_clock::now()) {}

  /// Sleeps until the next multiple; returns at once when that has passed.
  void wait() {
    next_ += period_;
    std::this_thread::sleep_until(next_);
  }

 private:
  std::chrono::nanoseconds period_;
  std::chrono::steady_clock::time_point next_;
};

}  // namespace twin::runtime

#pragma once

#include <chrono>
#include <cstdint>

namespace twin::hal::rig::guard {

/// Notices that a count which should go on has stood still for too long.
class HeartbeatTimer {
 public:
  using Time = std::chrono::nanoseconds;  ///< of a monotonic clock

  explicit HeartbeatTimer(Time timeout) noexcept : timeout_(timeout) {}

  /// Takes a look at the count.
  /// @returns true once it has been the same for longer than the timeout while it was expected to
  /// go on. The time before it is expected does not count.
  bool is_late(Time now, std::uint64_t count, bool is_expected) noexcept {
    if (!is_expected || !was_expected_ || count != count_) {
      count_ = count;
      changed_ = now;
    }
    was_expected_ = is_expected;
    return is_expected && now - changed_ > timeout_;
  }

 private:
  Time timeout_;
  Time changed_{};
  std::uint64_t count_ = 0;
  bool was_expected_ = false;
};

}  // namespace twin::hal::rig::guard

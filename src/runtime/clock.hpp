#pragma once

#include <cstdint>

namespace twin::runtime {

/// Time on which periods are paced; tests have one of their own.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  /// [ns], never falls. Real-time safe.
  virtual std::int64_t now() noexcept = 0;
  /// Returns at that instant or later; at once when it has passed. Real-time safe. @param t [ns]
  virtual void sleep_until(std::int64_t t) noexcept = 0;
};

/// CLOCK_MONOTONIC, with absolute sleeps.
class MonotonicClock final : public Clock {
 public:
  std::int64_t now() noexcept override;
  void sleep_until(std::int64_t t) noexcept override;
};

}  // namespace twin::runtime

#pragma once

#include <cstdint>
#include <optional>

#include "core/wall_clock.hpp"
#include "motion/safety/trip.hpp"

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

/// How a period began.
struct WakeUp {
  double latency = 0.0;   ///< after its deadline [s]
  double interval = 0.0;  ///< since the period before began [s]
  int missed = 0;         ///< periods before it that never began; Schedule::kKept only
};

/// What becomes of the deadlines after a late period.
enum class Schedule : std::uint8_t {
  kShifted,  ///< the next is a period after this wake-up: for a machine whose time passes in read()
  kKept,     ///< they stay where they are and some are missed: for one whose time passes by itself
};

/// Wakes up at the multiples of a period.
///
/// A wake-up at or past the next deadline is a late period. A burst of short periods never makes up
/// for it: the schedule is shifted, or the periods in between are missed.
class Pacer {
 public:
  /// @param clock   outlives the pacer; the first deadline is one period after now
  /// @param period  [s]
  Pacer(Clock& clock, double period, const RealtimeSettings& settings,
        Schedule schedule = Schedule::kShifted) noexcept;

  /// Sleeps until the next deadline. Real-time safe.
  WakeUp wait() noexcept;
  /// Since the deadline of this period [s]. Real-time safe.
  double since_deadline() const noexcept;

  /// Too many late periods in a row, or one too late, as of the last wait(). Real-time safe.
  std::optional<motion::Trip> overrun() const noexcept;

  std::int64_t late_periods() const noexcept { return late_periods_; }
  double worst_latency() const noexcept { return worst_latency_; }  ///< [s]

 private:
  Clock& clock_;
  std::int64_t period_;  // [ns]
  Schedule schedule_;
  std::int64_t deadline_;  // the last [ns]
  std::int64_t intended_;  // when the running period was to begin [ns]
  std::int64_t begun_;     // when it began [ns]
  int max_in_a_row_;
  double max_stall_;  // [s]
  int late_in_a_row_ = 0;
  std::int64_t late_periods_ = 0;
  double latency_ = 0.0;        // [s]
  double worst_latency_ = 0.0;  // [s]
};

}  // namespace twin::runtime

#pragma once

#include <cstdint>
#include <optional>

#include "core/wall_clock.hpp"
#include "motion/safety/trip.hpp"

namespace twin::runtime {

/// The clock by which periods are timed. Tests have a clock of their own.
class Clock {
 public:
  Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual ~Clock() = default;

  /// Present time, which never goes back [ns]. Real-time safe.
  virtual std::int64_t now() noexcept = 0;
  /// Sleeps until an instant; returns at once if the instant has passed. Real-time safe.
  /// @param t  the instant [ns]
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
  double latency = 0.0;   ///< time from its deadline to its begin [s]
  double interval = 0.0;  ///< time since the begin of the period before [s]
  int missed = 0;         ///< number of periods skipped before it; Schedule::kKept only
};

/// When the deadlines after a late period are.
enum class Schedule : std::uint8_t {
  kShifted,  ///< counted from the late wake-up, for a machine whose time passes in read()
  kKept,     ///< as before, so some are missed; for a machine whose time passes by itself
};

/// Wakes the caller at the begin of each period.
///
/// A period is late if it begins at or after the next deadline. The pacer never makes up for it by
/// a burst of short periods: it shifts the schedule or skips the periods in between (Schedule).
class Pacer {
 public:
  /// @param clock     outlives the pacer; the first deadline is one period after its present time
  /// @param period    [s]
  /// @param settings  when late periods are too many or too late
  Pacer(Clock& clock, double period, const RealtimeSettings& settings,
        Schedule schedule = Schedule::kShifted) noexcept;

  /// Sleeps until the next deadline. Real-time safe.
  WakeUp wait() noexcept;
  /// Time since the deadline of this period [s]. Real-time safe.
  double since_deadline() const noexcept;

  /// A trip if, as of the last wait(), too many periods in a row were late or one was far too late;
  /// else nothing. Real-time safe.
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

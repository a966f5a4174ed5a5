#pragma once

#include <cstdint>
#include <optional>

#include "core/realtime_settings.hpp"
#include "runtime/clock.hpp"
#include "safety/trip.hpp"

namespace twin::runtime {

/// How a period began.
struct WakeUp {
  double latency = 0.0;   ///< after its deadline [s]
  double interval = 0.0;  ///< since the period before began [s]
};

/// Wakes up at the multiples of a period.
///
/// A wake-up at or past the next deadline is a late period. Then the schedule is shifted: the next
/// deadline is a period after this wake-up, so a stall is never made up for by a burst of short
/// periods. The path takes no notice, only the wall clock does: set points are counted in periods.
class Pacer {
 public:
  /// @param clock   outlives the pacer; the first deadline is one period after now
  /// @param period  [s]
  Pacer(Clock& clock, double period, const RealtimeSettings& settings) noexcept;

  /// Sleeps until the next deadline. Real-time safe.
  WakeUp wait() noexcept;
  /// Since the deadline of this period [s]. Real-time safe.
  double since_deadline() const noexcept;

  /// Too many late periods in a row, or one too late, as of the last wait(). Real-time safe.
  std::optional<safety::Trip> overrun() const noexcept;

  std::int64_t late_periods() const noexcept { return late_periods_; }
  double worst_latency() const noexcept { return worst_latency_; }  ///< [s]

 private:
  Clock& clock_;
  std::int64_t period_;    // [ns]
  std::int64_t deadline_;  // of the running period [ns]
  std::int64_t begun_;     // when it began [ns]
  int max_in_a_row_;
  double max_stall_;  // [s]
  int late_in_a_row_ = 0;
  std::int64_t late_periods_ = 0;
  double latency_ = 0.0;        // [s]
  double worst_latency_ = 0.0;  // [s]
};

}  // namespace twin::runtime

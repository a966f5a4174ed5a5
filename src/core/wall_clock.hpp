#pragma once

#include <cerrno>
#include <cstdint>
#include <ctime>

/// The wall clock, and how a run keeps to it. It is CLOCK_MONOTONIC in whole nanoseconds: it never
/// falls and is the same for all processes of a machine.
namespace twin {

/// How a run on the wall clock keeps time; section [realtime] of the machine file.
struct RealtimeSettings {
  int priority = 80;          ///< SCHED_FIFO priority of the motion thread; 0: ordinary scheduling
  int cpu = -1;               ///< CPU that the motion thread stays on; -1: any
  bool lock_memory = true;    ///< keep the process's memory from being swapped out
  int max_late_periods = 10;  ///< so many late periods in a row end the motion
  double max_stall = 0.1;     ///< one period as late as this ends it too [s]
};

inline constexpr std::int64_t kNsPerS = 1'000'000'000;  ///< [ns/s]

/// Present time [ns]. Real-time safe.
inline std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

/// An instant as the system takes it. Real-time safe. @param time [ns]
inline timespec timespec_of(std::int64_t time) noexcept {
  timespec instant{};
  instant.tv_sec = static_cast<time_t>(time / kNsPerS);
  instant.tv_nsec = static_cast<long>(time % kNsPerS);
  return instant;
}

/// Returns at an instant or later, at once when it has passed. Absolute, so that what passes
/// between reading the clock and sleeping is not added. Real-time safe. @param time [ns]
inline void sleep_until_monotonic(std::int64_t time) noexcept {
  const timespec until = timespec_of(time);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace twin

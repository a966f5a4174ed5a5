#pragma once

#include <cstdint>

/// CLOCK_MONOTONIC in whole nanoseconds: never falls, the same for all processes of a machine.
namespace twin {

inline constexpr std::int64_t kNsPerS = 1'000'000'000;  ///< [ns/s]

/// Present time [ns]. Real-time safe.
std::int64_t monotonic_ns() noexcept;

/// Returns at an instant or later, at once when it has passed. Absolute, so that what passes
/// between reading the clock and sleeping is not added. Real-time safe. @param time [ns]
void sleep_until_monotonic(std::int64_t time) noexcept;

}  // namespace twin

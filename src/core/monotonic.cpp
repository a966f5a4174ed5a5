#include "core/monotonic.hpp"

#include <cerrno>
#include <ctime>

namespace twin {

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

void sleep_until_monotonic(std::int64_t time) noexcept {
  timespec until{};
  until.tv_sec = static_cast<time_t>(time / kNsPerS);
  until.tv_nsec = static_cast<long>(time % kNsPerS);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace twin

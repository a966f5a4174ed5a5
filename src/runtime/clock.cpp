#include "runtime/clock.hpp"

#include <cerrno>
#include <ctime>

namespace twin::runtime {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * kNsPerS + t.tv_nsec;
}

void MonotonicClock::sleep_until(std::int64_t t) noexcept {
  timespec until{};
  until.tv_sec = static_cast<time_t>(t / kNsPerS);
  until.tv_nsec = static_cast<long>(t % kNsPerS);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace twin::runtime

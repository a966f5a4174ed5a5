#include "runtime/clock.hpp"

#include "core/monotonic.hpp"

namespace twin::runtime {

std::int64_t MonotonicClock::now() noexcept { return monotonic_ns(); }

void MonotonicClock::sleep_until(std::int64_t t) noexcept { sleep_until_monotonic(t); }

}  // namespace twin::runtime

#include "hal/rig/guard/guard_loop.hpp"

#include <poll.h>
#include <time.h>

#include <cerrno>

#include "hal/rig/guard/heartbeat_timer.hpp"

namespace twin::hal::rig::guard {
namespace {

constexpr int kTurn = 1;  // [ms]

/// @returns true when the other end is closed
bool is_closed(int lifeline, int timeout_ms) noexcept {
  pollfd end{lifeline, 0, 0};
  return poll(&end, 1, timeout_ms) > 0 && (end.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

/// Waits for a turn. @returns true when the owner of the mutex has died
bool owner_dies(pthread_mutex_t& owner, int lifeline) noexcept {
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  until.tv_nsec += kTurn * 1'000'000L;
  if (until.tv_nsec >= 1'000'000'000L) {
    until.tv_nsec -= 1'000'000'000L;
    ++until.tv_sec;
  }
  const int result = pthread_mutex_clocklock(&owner, CLOCK_MONOTONIC, &until);
  if (result == 0) {  // nobody holds it: the turn is waited for here
    pthread_mutex_unlock(&owner);
    is_closed(lifeline, kTurn);
  }
  // A mutex that was taken over from the dead is kept: later turns wait for it in vain, as they
  // should.
  return result == EOWNERDEAD;
}

}  // namespace

void run_guard(GuardPage& page, int lifeline, std::chrono::nanoseconds timeout,
               const std::function<void()>& make_safe) {
  HeartbeatTimer timer(timeout);
  page.state = GuardState::kWatching;
  bool was_late = false;
  for (bool is_gone = false; !is_gone;) {
    const bool is_dead = owner_dies(page.owner, lifeline);
    is_gone = is_closed(lifeline, 0);
    const bool is_armed = page.is_armed.load(std::memory_order_acquire);
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const bool is_late = timer.is_late(now, page.heartbeats.load(), is_armed);
    const bool is_silent = is_late && was_late;
    was_late = is_late;
    if (((is_gone || is_dead) && is_armed) || is_silent || page.state == GuardState::kActed) {
      page.state = GuardState::kActed;
      make_safe();
    }
    page.turns.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace twin::hal::rig::guard

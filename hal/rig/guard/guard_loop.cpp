#include "hal/rig/guard/guard_loop.hpp"

#include <poll.h>

#include "hal/rig/guard/heartbeat_timer.hpp"

namespace twin::hal::rig {
namespace {

constexpr int kTurn = 1;  // [ms]

/// Waits for a turn. @returns true when the other end is closed
bool wait_on(int lifeline) noexcept {
  pollfd end{lifeline, 0, 0};
  return poll(&end, 1, kTurn) > 0 && (end.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

}  // namespace

void run_guard(GuardPage& page, int lifeline, std::chrono::nanoseconds timeout,
               const std::function<void()>& make_safe) {
  HeartbeatTimer timer(timeout);
  page.state = GuardState::kWatching;
  bool was_late = false;
  for (bool is_gone = false; !is_gone;) {
    is_gone = wait_on(lifeline);
    const bool is_armed = page.is_armed.load(std::memory_order_acquire);
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    const bool is_late = timer.is_late(now, page.heartbeats.load(), is_armed);
    const bool is_silent = is_late && was_late;
    was_late = is_late;
    if ((is_gone && is_armed) || is_silent || page.state == GuardState::kActed) {
      page.state = GuardState::kActed;
      make_safe();
    }
    page.turns.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace twin::hal::rig

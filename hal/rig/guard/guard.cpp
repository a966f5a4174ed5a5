#include "hal/rig/guard/guard.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <cerrno>
#include <charconv>
#include <memory>
#include <string_view>
#include <utility>

#include "core/wall_clock.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "hal/rig/daqnavi_cards.hpp"
#include "hal/rig/guard/heartbeat_timer.hpp"
#include "hal/rig/io_port/port_address.hpp"
#include "hal/rig/pci1716.hpp"

namespace twin::hal::rig::guard {
namespace {

using MakeSafe = std::function<void()>;

/// The part of a text behind a prefix, if it has that.
bool take_prefix(std::string_view& text, std::string_view prefix) {
  const bool has_it = text.starts_with(prefix);
  if (has_it) {
    text.remove_prefix(prefix.size());
  }
  return has_it;
}

Expected<MakeSafe> open_shared(const std::string& name, std::uint16_t digital) {
  TWIN_TRY(auto attached, boards::SharedRegisters::attach(name, boards::SharedRole::kObserver));
  const std::shared_ptr<boards::SharedRegisters> shared = std::move(attached);
  const auto port = std::make_shared<boards::EmulatedPci1716>(shared->boards().pci1716);
  return [shared, port, digital] { make_safe(*port, digital); };
}

Expected<MakeSafe> open_daqnavi(std::string_view library_and_board, std::uint16_t digital) {
  const std::size_t colon = library_and_board.rfind(':');
  const std::string_view number =
      library_and_board.substr(std::min(colon, library_and_board.size()));
  int board_id = -1;
  if (number.size() < 2 ||
      std::from_chars(number.data() + 1, number.data() + number.size(), board_id).ec !=
          std::errc()) {
    return fail(ErrorCode::kUsage, fmt::format("daqnavi:{} has no board ID", library_and_board));
  }
  TWIN_TRY(auto cards, DaqnaviCards::open_outputs_only(
                           std::string(library_and_board.substr(0, colon)), board_id, digital));
  return [open = std::shared_ptr<Cards>(std::move(cards))] { open->make_safe(); };
}

Expected<MakeSafe> open_registers(std::string_view address, std::uint16_t digital) {
  return io_port::port_address_from_text(address)
      .and_then(io_port::open_port)
      .map([digital](std::unique_ptr<io_port::IoPort> opened) {
        const std::shared_ptr<io_port::IoPort> port = std::move(opened);
        return MakeSafe([port, digital] { make_safe(*port, digital); });
      });
}

constexpr int kTurn = 1;  // [ms]

/// @returns true when the other end is closed
bool is_closed(int lifeline, int timeout_ms) noexcept {
  pollfd end{lifeline, 0, 0};
  return poll(&end, 1, timeout_ms) > 0 && (end.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0;
}

/// Locks the mutex, or gives up after a turn. @returns what the lock says
int lock_within_a_turn(pthread_mutex_t& owner) noexcept {
#ifdef __SANITIZE_THREAD__
  // The thread sanitizer of g++ 12 does not know pthread_mutex_clocklock, and would take every page
  // of this mutex for unlocked.
  timespec until{};
  clock_gettime(CLOCK_REALTIME, &until);
  until.tv_nsec += kTurn * 1'000'000;
  until.tv_sec += until.tv_nsec / 1'000'000'000;
  until.tv_nsec %= 1'000'000'000;
  return pthread_mutex_timedlock(&owner, &until);
#else
  const timespec until = timespec_of(monotonic_ns() + kTurn * 1'000'000);
  return pthread_mutex_clocklock(&owner, CLOCK_MONOTONIC, &until);
#endif
}

/// Waits for a turn. @returns true when the owner of the mutex has died
bool owner_dies(pthread_mutex_t& owner, int lifeline) noexcept {
  const int result = lock_within_a_turn(owner);
  if (result == 0) {  // nobody holds it: the turn is waited for here
    pthread_mutex_unlock(&owner);
    is_closed(lifeline, kTurn);
  }
  // A mutex that was taken over from the dead is kept: later turns wait for it in vain, as they
  // should.
  return result == EOWNERDEAD;
}

}  // namespace

Expected<MakeSafe> open_guarded_outputs(const std::string& outputs, unsigned digital) {
  const auto levels = static_cast<std::uint16_t>(digital);
  std::string_view rest = outputs;
  if (take_prefix(rest, "shared:")) {
    return open_shared(std::string(rest), levels);
  }
  if (take_prefix(rest, "daqnavi:")) {
    return open_daqnavi(rest, levels);
  }
  return open_registers(rest, levels);
}

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

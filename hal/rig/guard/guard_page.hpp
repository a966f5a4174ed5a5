#pragma once

#include <pthread.h>

#include <array>
#include <atomic>
#include <cstdint>

namespace twin::hal::rig::guard {

/// What the guard is doing.
enum class GuardState : std::uint32_t {
  kStarting,  ///< opening the card
  kWatching,  ///< has the card and counts heartbeats
  kActed,     ///< has made the outputs safe and keeps them so
  kFailed,    ///< could not open the card; `message` says why
};

/// Memory that controller and guard share. All zero at the start.
struct GuardPage {
  std::atomic<std::uint64_t> heartbeats{0};  ///< of the controller
  std::atomic<std::uint64_t> turns{0};       ///< of the guard's loop: its own sign of life
  std::atomic<bool> is_armed{false};         ///< heartbeats are expected
  std::atomic<GuardState> state{GuardState::kStarting};
  std::array<char, 512> message{};  ///< written before kFailed, ends in 0
  pthread_mutex_t owner{};          ///< robust; held by the controller as long as it lives
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace twin::hal::rig::guard

#pragma once

#include <pthread.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

/// What controller and guard say to each other: the guard's command line, and the memory that both
/// share.
namespace twin::hal::rig::guard {

/// The command line of twin-guard, which the controller writes and the guard reads.
struct GuardArguments {
  int page = -1;              ///< descriptor of the shared memory
  int lifeline = -1;          ///< descriptor of the read end of a pipe of the controller
  std::string outputs;        ///< where the outputs are: see open_guarded_outputs()
  unsigned safe_digital = 0;  ///< digital outputs with the servos off, 16 bits
  int timeout_ms = 0;         ///< longest silence of the controller [ms]
};

/// The arguments as a program gets them, without its name: each flag before its value.
std::vector<std::string> to_text(const GuardArguments& arguments);

/// The arguments back from their texts. Each flag must be there once and nothing else may be.
/// @returns a kUsage error that names the flag, what it was given and what it takes
Expected<GuardArguments> parse_guard_arguments(std::span<const char* const> texts);

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

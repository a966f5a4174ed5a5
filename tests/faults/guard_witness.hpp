#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

#include "tests/support/guard_view.hpp"

namespace twin::test {

/// Looks at a guard four times a millisecond, and tells a standstill of the machine from a guard
/// that is late.
///
/// The machine stood still between two looks that are kPause or more apart where the guard took
/// kTurns or fewer turns: neither of two processes that want to run each millisecond did. That time,
/// but for a look's, is not the guard's. A guard that stands still while this process goes on is
/// late, and so is one that waits longer than it should: then there are looks in between.
class GuardWitness {
 public:
  explicit GuardWitness(const GuardView& guard) : guard_(guard) {}

  /// Waits for more heartbeats of the controller. @returns false if none come
  bool sees_heartbeats(std::uint64_t count) {
    const std::uint64_t first = guard_.heartbeats();
    return standstill_until(monotonic(), [&] { return guard_.heartbeats() >= first + count; })
        .has_value();
  }

  /// Looks until something is so.
  ///
  /// @param begin  where the time begins that is of interest, just now [s]
  /// @returns how long the machine stood still since then [s]; nothing if it is not so in time
  std::optional<double> standstill_until(double begin, const std::function<bool()>& is_so) {
    constexpr double kLongest = 10.0;  // [s]
    last_ = begin;
    turns_ = guard_.turns();
    double sum = 0.0;
    while (!is_so()) {
      if (last_ > begin + kLongest) {
        return std::nullopt;
      }
      sum += look();
    }
    return sum;
  }

 private:
  static constexpr double kLook = 0.25e-3;  // [s]
  static constexpr double kPause = 0.005;   // [s]
  static constexpr std::uint64_t kTurns = 2;

  /// Waits and looks. @returns how long the machine stood still meanwhile [s]
  double look() {
    std::this_thread::sleep_for(std::chrono::duration<double>(kLook));
    const double now = monotonic();
    const std::uint64_t turns = guard_.turns();
    const bool stood_still = now - last_ >= kPause && turns - turns_ <= kTurns;
    const double standstill = stood_still ? now - last_ - kLook : 0.0;
    last_ = now;
    turns_ = turns;
    return standstill;
  }

  const GuardView& guard_;
  double last_ = 0.0;  // look [s]
  std::uint64_t turns_ = 0;
};

}  // namespace twin::test

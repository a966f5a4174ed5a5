#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "runtime/override_schedule.hpp"

namespace twin::runtime {

/// What the motion is doing, as an operator sees it.
enum class MotionState : std::uint8_t {
  kWaiting,  ///< it has not begun
  kMoving,
  kHolding,  ///< braking to a feed hold, or at rest in it
  kStarved,  ///< at rest until enough of the path is planned
  kEnded,
};

/// Lies between whoever operates the run and the motion thread: the operator sets feed override and
/// feed hold, and the motion thread shows what it does. Every member may be called from every
/// thread; none waits.
class OperatorPanel {
 public:
  /// What is wanted.
  struct Wish {
    double percent = 100.0;  ///< feed override, 0 to 200; 0 holds [%]
    bool is_held = false;    ///< feed hold
    bool holds() const noexcept { return is_held || percent == 0.0; }
  };
  /// What the motion shows. The figures may be of different periods among the last few.
  struct Display {
    MotionState state = MotionState::kWaiting;
    double time = 0.0;       ///< since the first set point [s]
    double percent = 100.0;  ///< override that the feedrate is planned for [%]
    double feedrate = 0.0;   ///< [mm/s]
    std::int64_t line = 0;   ///< NC line
  };

  void set_override(double percent) noexcept {
    percent_.store(std::clamp(percent, 0.0, kHighestOverride), std::memory_order_relaxed);
  }
  void hold(bool is_held) noexcept { is_held_.store(is_held, std::memory_order_relaxed); }
  Wish wish() const noexcept {
    return {.percent = percent_.load(std::memory_order_relaxed),
            .is_held = is_held_.load(std::memory_order_relaxed)};
  }

  void show(const Display& display) noexcept {
    state_.store(display.state, std::memory_order_relaxed);
    time_.store(display.time, std::memory_order_relaxed);
    shown_percent_.store(display.percent, std::memory_order_relaxed);
    feedrate_.store(display.feedrate, std::memory_order_relaxed);
    line_.store(display.line, std::memory_order_relaxed);
  }
  Display display() const noexcept {
    return {.state = state_.load(std::memory_order_relaxed),
            .time = time_.load(std::memory_order_relaxed),
            .percent = shown_percent_.load(std::memory_order_relaxed),
            .feedrate = feedrate_.load(std::memory_order_relaxed),
            .line = line_.load(std::memory_order_relaxed)};
  }

 private:
  std::atomic<double> percent_{100.0};
  std::atomic<bool> is_held_{false};
  std::atomic<MotionState> state_{MotionState::kWaiting};
  std::atomic<double> time_{0.0};
  std::atomic<double> shown_percent_{100.0};
  std::atomic<double> feedrate_{0.0};
  std::atomic<std::int64_t> line_{0};
};

}  // namespace twin::runtime

#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "motion/interpolator/interpolator.hpp"

namespace twin::runtime {

/// What the motion thread asks the planning thread for: another plan of the rest of the path.
struct ReplanRequest {
  motion::PlanPlace from;   ///< where the motion is
  bool is_at_rest = false;  ///< it starts there; else at a place ahead
  double margin = 0.0;      ///< time of motion from there to that place, at least [s]
  double percent = 100.0;   ///< feed override, > 0 [%]
};

/// What the planning thread answers.
struct ReplanOffer {
  enum class Kind : std::uint8_t {
    kPlan,      ///< another plan, from this place on
    kPathEnd,   ///< the path ends before another plan could start
    kOnlyRest,  ///< no place ahead suits: brake first
  };
  Kind kind = Kind::kPlan;
  motion::PlanSwitch at;  ///< at rest only its plan means anything
  double distance = 0.0;  ///< of this place from the path's start [mm]
};

/// One request at a time from the motion thread to the planning thread, its answer, and whether it
/// is taken. Lock-free; the motion thread never waits in here.
///
///   idle --ask--> asked --offer--> offered --accept, reject--> accepted, rejected --close--> idle
///         motion         planning           motion                             planning
class ReplanLink {
 public:
  // Motion thread; real-time safe.

  bool is_idle() const noexcept { return stage() == Stage::kIdle; }
  /// When idle. @returns false, with nothing asked, otherwise
  bool ask(const ReplanRequest& request) noexcept {
    if (!is_idle()) {
      return false;
    }
    request_ = request;
    stage_.store(Stage::kAsked, std::memory_order_release);
    return true;
  }
  /// The answer, once it is there.
  const ReplanOffer* offer() const noexcept {
    return stage() == Stage::kOffered ? &offer_ : nullptr;
  }
  /// Takes the answer, or does not.
  void answer(bool is_accepted) noexcept {
    stage_.store(is_accepted ? Stage::kAccepted : Stage::kRejected, std::memory_order_release);
  }
  /// The motion has come to this segment.
  void report(std::int64_t segment) noexcept { segment_.store(segment, std::memory_order_relaxed); }
  /// Nobody will answer any more.
  bool is_broken() const noexcept { return is_broken_.load(std::memory_order_acquire); }

  // Planning thread.

  /// What was asked for and not answered yet.
  const ReplanRequest* request() const noexcept {
    return stage() == Stage::kAsked ? &request_ : nullptr;
  }
  void offer(const ReplanOffer& offer) noexcept {
    offer_ = offer;
    stage_.store(Stage::kOffered, std::memory_order_release);
  }
  /// Whether the offer was taken; nothing while the motion thread has not looked at it.
  std::optional<bool> verdict() const noexcept {
    const Stage now = stage();
    return now == Stage::kAccepted || now == Stage::kRejected
               ? std::optional(now == Stage::kAccepted)
               : std::nullopt;
  }
  void close() noexcept { stage_.store(Stage::kIdle, std::memory_order_release); }
  std::int64_t segment() const noexcept { return segment_.load(std::memory_order_relaxed); }
  void break_off() noexcept { is_broken_.store(true, std::memory_order_release); }

 private:
  enum class Stage : std::uint8_t { kIdle, kAsked, kOffered, kAccepted, kRejected };
  Stage stage() const noexcept { return stage_.load(std::memory_order_acquire); }

  std::atomic<Stage> stage_{Stage::kIdle};
  ReplanRequest request_;
  ReplanOffer offer_;
  std::atomic<std::int64_t> segment_{0};
  std::atomic<bool> is_broken_{false};
};

}  // namespace twin::runtime

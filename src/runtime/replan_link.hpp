#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "runtime/replanning.hpp"

namespace twin::runtime {

/// Requests for other plans between the motion thread and the planning thread, on the wall clock.
/// Lock-free: neither side waits in here.
///
///   idle --ask--> asked --offer--> offered --answer--> accepted or rejected --close--> idle
///        motion         planning           motion                            planning
class ReplanLink final : public Replanning {
 public:
  // Motion thread; real-time safe.

  bool ask(const ReplanRequest& request) noexcept override {
    if (stage() != Stage::kIdle) {
      return false;
    }
    request_ = request;
    stage_.store(Stage::kAsked, std::memory_order_release);
    return true;
  }
  const ReplanOffer* offer() const noexcept override {
    return stage() == Stage::kOffered ? &offer_ : nullptr;
  }
  void answer(Verdict verdict) noexcept override {
    stage_.store(verdict == Verdict::kAccepted ? Stage::kAccepted : Stage::kRejected,
                 std::memory_order_release);
  }
  void report(std::int64_t segment) noexcept override {
    segment_.store(segment, std::memory_order_relaxed);
  }

  // Planning thread.

  /// What was asked for and not answered yet; else null.
  const ReplanRequest* request() const noexcept {
    return stage() == Stage::kAsked ? &request_ : nullptr;
  }
  void offer(const ReplanOffer& offer) noexcept {
    offer_ = offer;
    stage_.store(Stage::kOffered, std::memory_order_release);
  }
  /// Nothing while the motion thread has not looked at the offer.
  std::optional<Verdict> verdict() const noexcept {
    switch (stage()) {
      case Stage::kAccepted:
        return Verdict::kAccepted;
      case Stage::kRejected:
        return Verdict::kRejected;
      default:
        return std::nullopt;
    }
  }
  void close() noexcept { stage_.store(Stage::kIdle, std::memory_order_release); }
  /// The segment that the motion has come to.
  std::int64_t segment() const noexcept { return segment_.load(std::memory_order_relaxed); }

 private:
  enum class Stage : std::uint8_t { kIdle, kAsked, kOffered, kAccepted, kRejected };
  Stage stage() const noexcept { return stage_.load(std::memory_order_acquire); }

  std::atomic<Stage> stage_{Stage::kIdle};
  ReplanRequest request_;
  ReplanOffer offer_;
  std::atomic<std::int64_t> segment_{0};
};

}  // namespace twin::runtime

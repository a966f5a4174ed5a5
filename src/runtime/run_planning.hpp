#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include "core/error.hpp"
#include "runtime/inline_planning.hpp"
#include "runtime/pace.hpp"
#include "runtime/planning_loop.hpp"
#include "runtime/program_planner.hpp"
#include "runtime/run.hpp"

namespace twin::runtime {

/// Planning of a run and the pace that goes with it.
class RunPlanning {
 public:
  RunPlanning() = default;
  RunPlanning(const RunPlanning&) = delete;
  RunPlanning& operator=(const RunPlanning&) = delete;
  virtual ~RunPlanning() = default;

  virtual PlanSupply& supply() noexcept = 0;
  virtual Replanning& replanning() noexcept = 0;
  /// For the motion thread, whose time begins with it.
  virtual std::unique_ptr<Pace> make_pace() = 0;

  /// Begins to plan, in a thread where there is one.
  virtual void start() = 0;
  /// The motion is over.
  virtual void stop() noexcept = 0;
  /// Waits until planning has ended. @returns why it failed
  virtual std::optional<Error> join() noexcept = 0;
};

/// Planning in the motion thread, and simulated time.
class LockstepPlanning final : public RunPlanning {
 public:
  /// @param stop  is set if planning fails
  LockstepPlanning(const RunRequest& request, ProgramPlanner& planner, std::atomic<bool>& stop);

  PlanSupply& supply() noexcept override { return planning_; }
  Replanning& replanning() noexcept override { return planning_; }
  std::unique_ptr<Pace> make_pace() override {
    return std::make_unique<LockstepPace>(planning_, stop_);
  }
  void start() override {}
  void stop() noexcept override {}
  std::optional<Error> join() noexcept override { return planning_.error(); }

 private:
  InlinePlanning planning_;
  std::atomic<bool>& stop_;
};

/// Planning in a thread of its own, and the wall clock.
class WallClockPlanning final : public RunPlanning {
 public:
  /// @param stop  is set if planning fails
  WallClockPlanning(const RunRequest& request, ProgramPlanner& planner, std::atomic<bool>& stop);

  PlanSupply& supply() noexcept override { return segments_; }
  Replanning& replanning() noexcept override { return link_; }
  std::unique_ptr<Pace> make_pace() override;
  void start() override;
  void stop() noexcept override { segments_.stop(); }
  std::optional<Error> join() noexcept override;

 private:
  void plan() noexcept;

  const RunRequest& request_;
  std::atomic<bool>& stop_;
  MonotonicClock clock_;
  BeatClock beat_;
  SegmentQueue segments_;
  ReplanLink link_;
  PlanningLoop loop_;
  std::optional<Error> error_;  // written by the thread, read after its end
  std::jthread thread_;
};

}  // namespace twin::runtime

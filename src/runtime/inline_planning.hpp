#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "runtime/program_planner.hpp"
#include "runtime/replanning.hpp"

namespace twin::runtime {

/// Planning in lockstep: in the thread of the motion, whenever it needs more of the plan.
///
/// A motion that follows this source never waits for a segment, and the answer to a request for
/// another plan is there at once. So nothing depends on the timing of threads.
class InlinePlanning final : public PlanSupply, public Replanning {
 public:
  /// As many segments are planned beyond the one that is followed as the motion needs to brake on
  /// them if planning fails, but path.look_ahead at most.
  InlinePlanning(ProgramPlanner& planner, const config::MachineFile& machine);

  /// Called before a segment is planned for the motion, with its number from 0.
  std::function<void(std::int64_t)> before_segment;

  /// Plans until enough segments wait. @returns false if planning has failed, see error()
  bool plan_ahead() noexcept;
  /// Why planning has failed. What was planned before can still be followed.
  const std::optional<Error>& error() const noexcept { return error_; }

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* segment) noexcept override;
  bool is_finished() const noexcept override;
  void adopt(std::int64_t plan) noexcept override { plan_ = plan; }
  double reach(std::int64_t plan) const noexcept override;
  bool is_primed() const noexcept override { return true; }

  bool ask(const ReplanRequest& request) noexcept override;
  const ReplanOffer* offer() const noexcept override { return offer_ ? &*offer_ : nullptr; }
  void answer(Verdict verdict) noexcept override;
  void report(std::int64_t segment) noexcept override { planner_.drop_before(segment); }

 private:
  Expected<void> plan_on();

  ProgramPlanner& planner_;
  std::size_t most_ahead_;                         // segments
  double length_ahead_;                            // [mm]
  std::deque<feedrate::PlannedSegment> followed_;  // handed out and not released
  std::int64_t plan_ = 0;                          // that is followed
  std::int64_t handed_out_ = 0;
  std::int64_t announced_ = 0;  // segments that before_segment was told of
  ReplanRequest request_;
  std::optional<ReplanOffer> offer_;
  std::optional<Error> error_;
};

}  // namespace twin::runtime

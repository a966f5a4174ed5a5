#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "path/builder.hpp"
#include "runtime/kept_path.hpp"
#include "runtime/plan_version.hpp"
#include "runtime/planning.hpp"
#include "runtime/replanning.hpp"
#include "runtime/shared_blocks.hpp"

namespace twin::runtime {

/// Plans a program from its text to planned segments, as far as it is asked to, and makes other
/// plans of the rest of the path while it is followed.
///
/// For another plan the path that was built already is planned again from a place where the present
/// plan has no tangential acceleration, with the programmed feedrates scaled:
///
///   present plan  --------x------------------
///                         |                        x  place of the switch
///   other plan            x------------------
///
/// Up to x the motion follows the present plan exactly, so the set points have no step in place,
/// feedrate or acceleration there. The other plan is made in full first and offered. It replaces
/// the present one when it is accepted, that is when the motion has not passed x; a rejected one is
/// dropped, and nothing has happened.
///
/// What is offered depends on the program and on the request alone, never on how far planning is.
class ProgramPlanner {
 public:
  /// Whether the path may be planned again while it is followed.
  enum class Replans : std::uint8_t { kNever, kOnRequest };

  /// @param percent  feed override of the first plan, > 0 [%]
  ProgramPlanner(BlockSource blocks, const config::MachineFile& machine, Replans replans,
                 double percent = 100.0);
  ProgramPlanner(const ProgramPlanner&) = delete;
  ProgramPlanner& operator=(const ProgramPlanner&) = delete;
  ~ProgramPlanner() = default;

  /// Starts with the whole path planned already. @param segments  of the first plan
  void preload(std::deque<feedrate::PlannedSegment>&& segments, const PlanFigures& figures);
  /// Reads and plans on until so many segments wait, or fewer that are so long together [mm], or
  /// the whole path is planned.
  Expected<void> plan_ahead(std::size_t segments,
                            double length = std::numeric_limits<double>::infinity());

  /// Number of planned segments that wait to be followed.
  std::size_t waiting() const noexcept { return older_.size() + active_->ready().size(); }
  /// The first of them.
  feedrate::PlannedSegment& front() noexcept {
    return older_.empty() ? active_->ready().front() : older_.front();
  }
  void pop_front();
  /// Distance from the path's start up to which the first one extends its plan [mm].
  double reach_of_front() noexcept;
  /// Whether the path is planned to its end.
  bool is_all_planned() const noexcept { return is_all_read_; }
  /// Number of the plan in force.
  std::int64_t plan() const noexcept { return active_->number(); }

  /// The motion has come to this segment: what lies behind it need not be kept.
  void drop_before(std::int64_t segment);
  /// Makes another plan.
  Expected<ReplanOffer> offer(ReplanRequest request);
  /// Distance from the path's start to where the plan offered begins [mm].
  double start_of_offer() const noexcept { return start_of_candidate_; }
  /// Puts the plan that was offered last in force, or drops it.
  void conclude(const ReplanOffer& offer, const ReplanRequest& request, Verdict verdict);

  /// What has been planned so far.
  PlanFigures figures() const;

 private:
  struct Start {
    PlanStart plan;
    motion::PlanSwitch at;
    double distance = 0.0;  // from the path's start [mm]
    double after = 0.0;     // time of motion until there [s]
  };

  bool replans() const noexcept { return replans_ == Replans::kOnRequest; }
  bool is_ahead(std::size_t segments, double length) noexcept;
  Expected<void> read_on();
  void append(path::Segment&& segment);
  Expected<bool> has_segment(std::int64_t index);
  Start start_at(std::int64_t segment, double s, double v, double percent) const;
  Expected<std::optional<Start>> start_at_rest(const ReplanRequest& request);
  Expected<std::optional<Start>> start_ahead(const ReplanRequest& request);
  Expected<bool> make_candidate(const Start& start);
  void put_into_force(const motion::PlanSwitch& at, bool is_at_rest);

  BlockSource blocks_;
  const config::MachineFile& machine_;
  Replans replans_;
  std::unique_ptr<path::Builder> builder_;
  KeptPath path_;
  std::unique_ptr<PlanVersion> active_;
  std::unique_ptr<PlanVersion> candidate_;
  std::deque<feedrate::PlannedSegment> older_;  // of plans before, up to the switch
  double start_of_active_ = 0.0;                // distance from the path's start [mm]
  double start_of_candidate_ = 0.0;             // the same
  bool is_all_read_ = false;
  PlanFigures figures_;
};

}  // namespace twin::runtime

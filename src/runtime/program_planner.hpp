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

/// Plans a program from its text to planned segments, as far ahead as the motion needs. When the
/// feed override changes, it makes another plan of the rest of the path while the motion goes on.
///
/// Another plan uses the path that is built already, with other feedrates. It starts at a place
/// where the present plan has no tangential acceleration:
///
///   present plan  --------x------------------
///                         |                        x  place of the switch
///   other plan            x------------------
///
/// Up to x the motion follows the present plan exactly, so the set points have no step of place,
/// feedrate or acceleration at x. The other plan is computed first and then offered. If the motion
/// has not passed x, it accepts, and the other plan replaces the present one. If the motion rejects
/// the offer, the other plan is dropped and nothing has changed.
///
/// An offer depends on the program and on the request alone, never on how far ahead the present
/// plan has come.
class ProgramPlanner {
 public:
  /// Whether other plans may be asked for. If so, the path ahead of the motion is kept in memory.
  enum class Replans : std::uint8_t { kNever, kOnRequest };

  /// @param percent  feed override of the first plan, > 0 [%]
  ProgramPlanner(BlockSource blocks, const config::MachineFile& machine, Replans replans,
                 double percent = 100.0);
  ProgramPlanner(const ProgramPlanner&) = delete;
  ProgramPlanner& operator=(const ProgramPlanner&) = delete;
  ~ProgramPlanner() = default;

  /// Takes a plan of the whole program that was made before, so that nothing is left to plan.
  /// @param segments  all segments of that plan
  /// @param figures   lengths, counts and times of that plan
  void preload(std::deque<feedrate::PlannedSegment>&& segments, const PlanFigures& figures);
  /// Reads and plans on until enough segments wait or the whole path is planned.
  /// @param segments  so many waiting segments are enough
  /// @param length    so are fewer, if they are at least this long together [mm]
  Expected<void> plan_ahead(std::size_t segments,
                            double length = std::numeric_limits<double>::infinity());

  /// Number of planned segments that wait to be followed.
  std::size_t waiting() const noexcept { return older_.size() + active_->ready().size(); }
  /// The first segment that waits; there must be one.
  feedrate::PlannedSegment& front() noexcept {
    return older_.empty() ? active_->ready().front() : older_.front();
  }
  /// Removes the first segment that waits.
  void pop_front();
  /// How far its plan is known once the motion has got the first waiting segment: distance from the
  /// start of the path [mm].
  double reach_of_front() noexcept;
  /// Whether the path is planned to its end.
  bool is_all_planned() const noexcept { return is_all_read_; }
  /// Number of the plan in force; the first plan is 0.
  std::int64_t plan() const noexcept { return active_->number(); }

  /// Says that the motion has come to this segment, so the path well behind it can be dropped.
  void drop_before(std::int64_t segment);
  /// Makes another plan.
  /// @returns the place where the other plan would take over, or why there is none
  Expected<ReplanOffer> offer(ReplanRequest request);
  /// Distance from the start of the path to the place where the offered plan begins [mm].
  double start_of_offer() const noexcept { return start_of_candidate_; }
  /// Puts the plan that was offered last in force, or drops it, as the verdict says.
  void conclude(const ReplanOffer& offer, const ReplanRequest& request, Verdict verdict);

  /// Lengths, counts and time of everything planned so far.
  PlanFigures figures() const;

 private:
  /// Where another plan would start.
  struct Start {
    PlanStart plan;
    motion::PlanSwitch at;
    double distance = 0.0;  // from the start of the path to there [mm]
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
  std::deque<feedrate::PlannedSegment> older_;  // of earlier plans, up to the place of the switch
  double start_of_active_ = 0.0;                // distance from the start of the path [mm]
  double start_of_candidate_ = 0.0;             // the same, of the plan that is offered [mm]
  bool is_all_read_ = false;
  PlanFigures figures_;
};

}  // namespace twin::runtime

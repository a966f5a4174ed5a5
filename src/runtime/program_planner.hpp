#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/reader.hpp"
#include "path/builder.hpp"
#include "runtime/kept_path.hpp"
#include "runtime/plan_version.hpp"
#include "runtime/planning.hpp"
#include "runtime/replan_link.hpp"
#include "runtime/segment_queue.hpp"

namespace twin::runtime {

/// The body of the planning thread: text to planned segments, and other plans of the rest of the
/// path while it is followed.
///
/// For another plan the path that was built already is planned again from a place where the present
/// plan has no tangential acceleration, with the programmed feedrates scaled:
///
///   present plan  --------x------------------
///                         |                        x  place of the switch
///   other plan            x------------------
///
/// Up to x the motion follows the present plan exactly, so the set points have no step in place,
/// feedrate or acceleration there. The other plan is made in full first, offered, and handed on
/// only when the motion has not passed x; else it is dropped and nothing has happened.
///
/// What is offered depends on the program and on the request alone, never on how far planning is.
class ProgramPlanner {
 public:
  /// @param link     null: there will be no other plan
  /// @param percent  feed override of the first plan, > 0 [%]
  ProgramPlanner(gcode::Reader& reader, const config::MachineFile& machine, SegmentQueue& queue,
                 ReplanLink* link, double percent = 100.0);
  ProgramPlanner(const ProgramPlanner&) = delete;
  ProgramPlanner& operator=(const ProgramPlanner&) = delete;
  ~ProgramPlanner() = default;

  /// Called before a segment is handed on, with its number from 0.
  std::function<void(std::int64_t)> before_segment;

  /// Plans until the path is handed on; with a link until the motion is over.
  Expected<PlanFigures> run();

 private:
  struct Start {
    PlanStart plan;
    motion::PlanSwitch at;
    double distance = 0.0;  // from the path's start [mm]
    double after = 0.0;     // time of motion until there [s]
  };

  bool hand_on();
  Expected<void> read_on();
  void take(path::Segment&& segment);
  Expected<void> serve();
  Expected<ReplanOffer> replan(ReplanRequest request);
  Expected<bool> has_segment(std::int64_t index);
  Start start_at(std::int64_t segment, double s, double v, double percent) const;
  Expected<std::optional<Start>> start_at_rest(const ReplanRequest& request);
  Expected<std::optional<Start>> start_ahead(const ReplanRequest& request);
  Expected<bool> make_candidate(const Start& start);
  void put_into_force(const motion::PlanSwitch& at, bool is_at_rest);

  gcode::Reader& reader_;
  const config::MachineFile& machine_;
  SegmentQueue& queue_;
  ReplanLink* link_;
  std::unique_ptr<path::Builder> builder_;
  KeptPath path_;
  std::unique_ptr<PlanVersion> active_;
  std::unique_ptr<PlanVersion> candidate_;
  std::deque<feedrate::PlannedSegment> older_;  // of plans before, up to the switch
  double start_of_active_ = 0.0;                // distance from the path's start [mm]
  double start_of_candidate_ = 0.0;             // the same
  bool is_all_read_ = false;
  std::int64_t handed_on_ = 0;
  bool is_announced_ = false;  // the next segment to hand on, to before_segment
  PlanFigures figures_;
};

}  // namespace twin::runtime

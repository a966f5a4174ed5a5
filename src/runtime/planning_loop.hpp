#pragma once

#include <cstdint>
#include <functional>

#include "core/error.hpp"
#include "runtime/program_planner.hpp"
#include "runtime/replan_link.hpp"
#include "runtime/segment_queue.hpp"

namespace twin::runtime {

/// The body of the planning thread, on the wall clock: keeps the segment queue full and answers
/// requests for other plans, until the motion is over.
class PlanningLoop {
 public:
  /// @param look_ahead  segments beyond the motion that are queued at most
  PlanningLoop(ProgramPlanner& planner, SegmentQueue& queue, ReplanLink& link, int look_ahead)
      : planner_(planner), queue_(queue), link_(link), look_ahead_(look_ahead) {}

  /// Called before a segment is queued, with its number from 0.
  std::function<void(std::int64_t)> before_segment;

  /// Plans until the motion is over.
  Expected<void> run();

 private:
  Expected<void> serve();
  bool queue_front();

  ProgramPlanner& planner_;
  SegmentQueue& queue_;
  ReplanLink& link_;
  int look_ahead_;
  std::int64_t announced_ = 0;  // segments that before_segment was told of
  bool is_announced_ = false;   // the next segment is one of them
};

}  // namespace twin::runtime

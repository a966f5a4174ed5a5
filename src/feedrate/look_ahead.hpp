#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/planned_segment.hpp"
#include "feedrate/planner.hpp"
#include "feedrate/window_limits.hpp"

namespace twin::feedrate {

/// Look-ahead: takes segments and emits them with their feedrate.
///
/// The look-ahead keeps a window of segments. Their feedrate is planned as if the path ended at
/// rest at the horizon, just before the end of the window. The end of such a plan only brakes, so
/// only the part before that braking is final; its segments leave the window:
///
///            final since      becomes final        braking to rest     limits may
///            the last plan    by this plan         at the horizon      still fall
///   emitted |---------------|--------------------|-------------------|------------|
///           begin of        start of                                 horizon      end of
///           the window      the plan                                              the window
///
/// The parts of the planner (PlannerParts) decide what the limits are, when a plan is due, how the
/// window is planned and which part of the plan is final. The result depends on the segments alone,
/// not on when they arrive.
class LookAhead {
 public:
  using Sink = std::function<void(PlannedSegment&&)>;
  using Start = PlanStart;

  /// @param path            settings of the planner. With planner = paper the window has
  ///                        path.look_ahead segments, at least 2; with planner = certified it is
  ///                        some braking distances long.
  /// @param period          interpolation period, on which the limits of corners and chords
  ///                        depend [s]
  /// @param sink            gets each segment once its feedrate is final
  /// @param start           where the plan starts in the first segment, and at which feedrate. If
  ///                        this is faster than the feedrate asked for, the motion slows down as
  ///                        soon as it can; the limits of the path itself are kept all the same.
  /// @param override_scale  factor > 0 on programmed feedrates; rapids use at most 1 [-]
  LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Sink sink, Start start = {}, double override_scale = 1.0);

  /// Takes the next segment of the path.
  void push(path::Segment&& segment);
  /// Says that no more segments follow: the path ends at rest, and all segments are emitted.
  void finish();

  /// How often no plan within all limits was found; see WindowPlanner::fallbacks().
  std::int64_t fallbacks() const noexcept { return planner_->fallbacks(); }

 private:
  LookAhead(const PlannerParts& parts, const Limits& limits, const PlanningModel& model,
            double period, Sink sink, const Start& start, double override_scale);

  void plan(Tail tail);
  void emit_final(Tail tail);
  void append_phases(double begin, double end, std::size_t& next, PlannedSegment& planned);
  void append_stretches(double begin, double end, std::size_t& next, PlannedSegment& planned) const;
  void append_limits(double begin, double end, std::size_t& next, PlannedSegment& planned) const;
  void forget(double distance, std::size_t phases, std::size_t zones, std::size_t stretches);

  WindowLimits limits_;
  std::unique_ptr<WindowPlanner> planner_;
  Window window_;
  Sink sink_;
  std::int64_t next_index_ = 0;
};

}  // namespace twin::feedrate

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

/// Look-ahead: segments in, segments with feedrate out.
///
/// It keeps a window of segments, has their feedrate planned so that the path could end at rest at
/// the horizon, just before the window's end, and hands on the segments whose feedrate is final:
///
///   final | start ....... window ....... commit | braking to rest at the horizon | limits open
///         ^ end of what the last plan made final  ^ last place that the end does not slow down
///
/// What the limits are, when a plan is due, how the window is planned and which part of the plan is
/// final is up to the planner's parts. The result depends on the segments alone, not on when they
/// arrive.
class LookAhead {
 public:
  using Sink = std::function<void(PlannedSegment&&)>;
  using Start = PlanStart;

  /// A start that is faster than the feedrate asked for comes down to it as soon as it can; the
  /// limits of the path itself are kept all the same. The phases of the first segment begin at its
  /// place.
  ///
  /// @param path            with planner = paper path.look_ahead segments, at least 2, are in the
  ///                        window; with certified some braking distances of path
  /// @param period          interpolation period, for the feedrates of corners and chords [s]
  /// @param override_scale  of programmed feedrates, > 0; rapids take no more than 1 of it [-]
  LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Sink sink, Start start = {}, double override_scale = 1.0);

  void push(path::Segment&& segment);
  /// No more segments follow: the path ends at rest.
  void finish();

  /// How often a plan could not be made as wanted.
  std::int64_t fallbacks() const noexcept { return planner_->fallbacks(); }

 private:
  LookAhead(const PlannerParts& parts, const Limits& limits, const PlanningModel& model,
            double period, Sink sink, const Start& start, double override_scale);

  void plan(Tail tail);
  void emit_final(Tail tail);
  void append_phases(double begin, double end, std::size_t& next, PlannedSegment& planned);
  void append_limits(double begin, double end, std::size_t& next, PlannedSegment& planned) const;
  void forget(double distance, std::size_t phases, std::size_t zones);

  WindowLimits limits_;
  std::unique_ptr<WindowPlanner> planner_;
  Window window_;
  Sink sink_;
  std::int64_t next_index_ = 0;
};

}  // namespace twin::feedrate

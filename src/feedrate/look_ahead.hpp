#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/certified/certified_limits.hpp"
#include "feedrate/limits/feedrate_rule.hpp"
#include "feedrate/limits/junction_limits.hpp"
#include "feedrate/planned_segment.hpp"
#include "feedrate/window_planner.hpp"

namespace twin::feedrate {

/// Look-ahead: segments in, segments with feedrate out.
///
/// It keeps a window of segments whose feedrate is not settled, plans them so that the path could
/// end at rest at the horizon, just before the window's end, and settles the part that more
/// segments would not change:
///
///   settled | start ....... window ....... commit | braking to rest at the horizon | limits open
///           ^ end of what the last plan settled   ^ last place that the end does not slow down
///
/// Beyond the horizon a corner that is not known yet may still lower the limit of one that is; up
/// to it all limits are final. How the window is planned and what of it is settled is the
/// WindowPlanner's: HumpPlanner with planner = paper, GlidePlanner with certified. The result
/// depends on the segments alone, not on when they arrive.
class LookAhead {
 public:
  using Sink = std::function<void(PlannedSegment&&)>;

  /// Where a plan starts: with no acceleration at a place of the first segment.
  struct Start {
    double s;  ///< from the first segment's start [mm]
    double v;  ///< [mm/s]
  };

  /// A start that is faster than the feedrate asked for comes down to it as soon as it can; the
  /// limits of the path itself are kept all the same. The phases of the first segment begin at its
  /// place.
  ///
  /// @param path            with planner = paper path.look_ahead segments, at least 2, are in the
  ///                        window; with certified some braking distances of path
  /// @param period          interpolation period, for the feedrates of corners and chords [s]
  /// @param override_scale  of programmed feedrates, > 0; rapids take no more than 1 of it [-]
  LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Sink sink, Start start = {0.0, 0.0}, double override_scale = 1.0);

  void push(path::Segment&& segment);
  /// No more segments follow: the path ends at rest.
  void finish();

  /// How often a plan could not be made as wanted.
  std::int64_t fallbacks() const noexcept { return fallbacks_ + planner_->fallbacks(); }

 private:
  double asked_feedrate(const path::Segment& segment) const;
  RampLimits start_ramp() const;
  void take_limits(const path::Segment& segment);
  void append_limits(const path::Segment& segment, double feedrate, std::vector<LimitZone>& zones);
  void continue_zone(std::size_t index);
  RampLimits brake_limits(std::size_t zone, double begin, double end) const;
  bool is_due() const;
  void wait_for_more();
  double horizon_margin() const;
  double horizon(bool is_last) const;
  void plan(bool is_last);
  void emit_covered(bool is_last);
  void take_phases(double begin, double end, std::size_t& next, PlannedSegment& planned);
  void forget(double begin, std::size_t phases, std::size_t zones);

  Limits limits_;
  FeedrateRules rules_;
  CertifiedLimits certified_limits_;
  bool has_axis_limits_;
  bool is_certified_;
  std::size_t look_ahead_;
  double period_;
  Sink sink_;
  Start start_of_plan_;
  double override_scale_;
  RampLimits ramp_;
  std::unique_ptr<WindowPlanner> planner_;
  JunctionLimits junctions_;

  std::deque<path::Segment> window_;  // not yet handed on; window_[0] begins at s = 0
  Window work_;                       // measured as it is
  std::vector<LimitZone> asked_;      // of one segment, kept for its memory
  double length_ = 0.0;               // of the window [mm]
  double fastest_ = 0.0;              // feedrate asked for so far [mm/s]
  double due_length_ = 0.0;           // of the window at the next plan [mm]
  std::size_t due_segments_ = 0;      // in the window at the next plan
  std::size_t due_zones_ = 1;         // of the window at the next plan
  std::int64_t next_index_ = 0;
  std::int64_t fallbacks_ = 0;
};

}  // namespace twin::feedrate

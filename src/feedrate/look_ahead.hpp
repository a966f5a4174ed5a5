#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/envelope.hpp"
#include "feedrate/feedrate_rule.hpp"
#include "feedrate/junction_limits.hpp"
#include "feedrate/planned_segment.hpp"

namespace twin::feedrate {

/// Look-ahead: segments in, segments with feedrate out.
///
/// It keeps a window of up to `look_ahead` segments whose feedrate is not settled, plans them so
/// that the path could end at rest at the horizon, just before the window's end, and settles the
/// part that more segments would not change:
///
///   settled | start ....... window ....... commit | braking to rest at the horizon | limits open
///           ^ knot of the last plan               ^ last knot or hold that the end does not slow
///           down
///
/// Beyond the horizon a corner that is not known yet may still lower the limit of one that is; up
/// to it all limits are final. From the committed knot any feedrate can be reached with no
/// acceleration before the horizon, so the next plan can put its knots where it needs them. Should
/// one fail all the same, humps of the last one are taken, which only costs time. The result
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
  /// @param path            path.look_ahead segments, at least 2, are in the window
  /// @param period          interpolation period, for the feedrates of corners and chords [s]
  /// @param override_scale  of programmed feedrates, > 0; rapids take no more than 1 of it [-]
  LookAhead(const Limits& limits, const PlanningModel& model, const PathSettings& path,
            double period, Sink sink, Start start = {0.0, 0.0}, double override_scale = 1.0);

  void push(path::Segment&& segment);
  /// No more segments follow: the path ends at rest.
  void finish();

  /// How often a plan could not be made as wanted.
  std::int64_t fallbacks() const noexcept { return fallbacks_; }

 private:
  double asked_feedrate(const path::Segment& segment) const;
  void append_limits(const path::Segment& segment);
  double horizon(bool is_last) const;
  void plan(bool is_last);
  std::span<const LimitZone> zones_until(double last) const;
  void plan_evenly(double last);
  bool raise_limits(double last);
  double room_after(const Knot& knot, double last) const;
  Knot commit_knot(double last, bool is_last) const;
  void commit(Knot knot);
  void emit_covered(bool is_last);
  void take_phases(double begin, double end, std::size_t& next, PlannedSegment& planned);
  void forget(double begin, std::size_t phases, std::size_t zones);

  Limits limits_;
  FeedrateRules rules_;
  std::size_t look_ahead_;
  double period_;
  Sink sink_;
  Start start_of_plan_;
  double override_scale_;
  RampLimits ramp_;
  Envelope envelope_;
  JunctionLimits junctions_;

  std::deque<path::Segment> window_;  // not yet handed on; window_[0] begins at s = 0
  std::vector<LimitZone> zones_;      // of the window
  std::vector<LimitZone> asked_;      // of one segment, kept for its memory
  std::vector<Hump> plan_;            // last feasible plan from start_ to rest
  std::vector<Phase> phases_;         // settled and not yet handed on
  Knot start_;                        // where the next plan starts
  double length_ = 0.0;               // of the window [mm]
  std::int64_t next_index_ = 0;
  std::int64_t fallbacks_ = 0;
};

}  // namespace twin::feedrate

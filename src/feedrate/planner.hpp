#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"
#include "path/builder.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Whether the path goes on after the last segment of a window.
enum class Tail : std::uint8_t {
  kOpen,    ///< more segments follow
  kClosed,  ///< the path ends with the window, at rest
};

/// The segments that have not been handed on, and what is known of their feedrate. Places are
/// measured from the start of the first segment.
struct Window {
  std::deque<path::Segment> segments;
  double length = 0.0;           ///< of all segments together [mm]
  double fastest = 0.0;          ///< highest feedrate that was asked for so far [mm/s]
  std::vector<LimitZone> zones;  ///< limits of the whole window, in path order
  Anchor start;                  ///< up to this place the feedrate is final
  std::vector<Phase> phases;     ///< final, and not yet handed on
};

/// Where the feedrate limits inside a segment come from.
class LimitSource {
 public:
  LimitSource() = default;
  LimitSource(const LimitSource&) = delete;
  LimitSource& operator=(const LimitSource&) = delete;
  virtual ~LimitSource() = default;

  /// Appends the zones of a segment.
  ///
  /// @param s0        place of the segment's start [mm]
  /// @param feedrate  asked for on it: its programmed feedrate, unless that is overridden [mm/s]
  virtual void append(const path::Segment& segment, double s0, double feedrate,
                      std::vector<LimitZone>& zones) = 0;

  /// May make the first zone of a segment, zones[first], part of the zone before it.
  virtual void merge(std::vector<LimitZone>& zones, std::size_t first) const = 0;

  /// Acceleration and jerk that every zone leaves to the motion along the path.
  virtual RampLimits least_ramp() const = 0;

  /// Whether a zone may allow less acceleration or jerk than the machine.
  virtual bool has_zone_ramps() const = 0;
};

/// Plans the feedrate over a window and decides which part of it is final.
///
/// A plan comes to rest at the horizon. Beyond it a corner that is not known yet may still lower
/// the limit of one that is; up to it all limits are final. The part of a plan that more segments
/// would not change is final as well, and the next plan starts at its end.
class WindowPlanner {
 public:
  /// @param corner_reach  how far back a corner may lower the limits of others [mm]
  explicit WindowPlanner(double corner_reach) : corner_reach_(corner_reach) {}
  WindowPlanner(const WindowPlanner&) = delete;
  WindowPlanner& operator=(const WindowPlanner&) = delete;
  virtual ~WindowPlanner() = default;

  /// Whether enough of the path has come since the last plan.
  virtual bool is_due(const Window& window) const = 0;

  /// Plans the window, appends the final phases and moves its start to their end.
  /// @returns false, with nothing done, where the window does not reach beyond its start yet
  bool plan(Window& window, Tail tail);

  /// Sets when the next plan is due, from what is left in the window after the last one.
  virtual void schedule(const Window& window) = 0;

  /// Places are measured from a new start, that far from the old [mm].
  virtual void forget(double distance) = 0;

  /// How often a plan could not be made as wanted.
  std::int64_t fallbacks() const noexcept { return fallbacks_; }

 protected:
  /// @param horizon  place up to which all limits are final, and where the plan ends at rest [mm]
  virtual void advance(Window& window, double horizon, Tail tail) = 0;

  double corner_reach_;
  std::int64_t fallbacks_ = 0;
};

/// Raises the limits after a start that is too fast for them so far that it can come down.
/// @returns false where that has been done already
bool raise_limits(Window& window, double last, const RampLimits& ramp);

/// The parts of one planner, which belong together: what makes the path, where the limits inside
/// its segments come from, and how a window of it is planned.
///
///               paper                      certified
///   builder     path::PathBuilder          path::SmoothBuilder
///   limits      append_segment_limits      CertifiedLimits
///   window      HumpPlanner                GlidePlanner
class PlannerParts {
 public:
  PlannerParts() = default;
  PlannerParts(const PlannerParts&) = delete;
  PlannerParts& operator=(const PlannerParts&) = delete;
  virtual ~PlannerParts() = default;

  virtual std::unique_ptr<path::Builder> make_builder(path::Builder::Sink sink) const = 0;
  virtual std::unique_ptr<LimitSource> make_limits() const = 0;
  virtual std::unique_ptr<WindowPlanner> make_window_planner() const = 0;
};

/// The one place where the two planners are told apart: the parts of settings.planner.
/// @param period  interpolation period, for the feedrates of corners and chords [s]
std::unique_ptr<PlannerParts> make_planner(const Limits& limits, const PlanningModel& model,
                                           const PathSettings& settings, double period);

}  // namespace twin::feedrate

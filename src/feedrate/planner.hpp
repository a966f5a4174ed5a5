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
#include "feedrate/profile/stop.hpp"
#include "path/builder.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Whether the path goes on after the last segment of a window.
enum class Tail : std::uint8_t {
  kOpen,    ///< more segments follow
  kClosed,  ///< the path ends with the window, at rest
};

/// The segments that the look-ahead still holds, and what is known about their feedrate. Distances
/// are measured from the start of the first segment.
struct Window {
  std::deque<path::Segment> segments;
  double length = 0.0;             ///< length of all segments together [mm]
  double fastest = 0.0;            ///< highest feedrate that any segment so far asked for [mm/s]
  std::vector<LimitZone> zones;    ///< limits of the whole window, in path order
  Anchor start;                    ///< the feedrate is final up to this place; plans start here
  std::vector<Phase> phases;       ///< final motion of segments that are still in the window
  std::vector<Stretch> stretches;  ///< of the final motion, in path order; for
                                   ///< stops, where limits of ramps change
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
  /// @param s0        distance of the segment's start [mm]
  /// @param feedrate  feedrate asked for on the segment: the programmed one, with override [mm/s]
  virtual void append(const path::Segment& segment, double s0, double feedrate,
                      std::vector<LimitZone>& zones) = 0;

  /// Where the limits allow it, merges the first zone of a segment, zones[first], with the zone
  /// before.
  virtual void merge(std::vector<LimitZone>& zones, std::size_t first) const = 0;

  /// Tangential acceleration and jerk that are allowed in every zone.
  virtual RampLimits least_ramp() const = 0;

  /// Whether zones allow less jerk and acceleration the higher their limit is, so that a limit that no
  /// motion can reach is better lowered.
  virtual bool divides_jerk() const { return false; }
};

/// Plans the feedrate over a window and decides which part of it is final.
///
/// A plan comes to rest at the horizon, the place up to which all limits are final. Beyond the
/// horizon a corner that has not come yet may still lower the limits of corners that have. The part
/// of a plan that further segments would not change is final, and the next plan starts at its end.
///
///   start                                   horizon   end of the window
///     |------ final ------|---- may change ----|--------|
class WindowPlanner {
 public:
  /// @param corner_reach  how far back a corner may lower the limits of others [mm]
  explicit WindowPlanner(double corner_reach) : corner_reach_(corner_reach) {}
  WindowPlanner(const WindowPlanner&) = delete;
  WindowPlanner& operator=(const WindowPlanner&) = delete;
  virtual ~WindowPlanner() = default;

  /// Whether enough of the path has come since the last plan for the next one.
  virtual bool is_due(const Window& window) const = 0;

  /// Plans the window from its start to the horizon, appends the final phases to window.phases and
  /// moves window.start to their end.
  /// @returns false, with nothing done, if the horizon is not beyond the start yet
  bool plan(Window& window, Tail tail);

  /// Decides when the next plan is due, from what the last plan has left in the window.
  virtual void schedule(const Window& window) = 0;

  /// Follows a shift of the origin of all distances.
  /// @param distance  distance of the new origin from the old one [mm]
  virtual void forget(double distance) = 0;

  /// How often the planner had to do without a plan within all limits. It then followed an older
  /// plan, raised a limit, or stopped at the end of a window that had grown too large.
  std::int64_t fallbacks() const noexcept { return fallbacks_; }

 protected:
  /// Does the work of plan().
  /// @param horizon  distance up to which all limits are final; the plan ends at rest there [mm]
  virtual void advance(Window& window, double horizon, Tail tail) = 0;

  double corner_reach_;
  std::int64_t fallbacks_ = 0;
};

/// Makes a plan possible from a start that is too fast: raises the limits just after the start to
/// the feedrate of the start, over the distance that the motion needs to slow down.
/// @param last  distance up to which limits may be raised [mm]
/// @returns false if there was no limit to raise
bool raise_limits(Window& window, double last, const RampLimits& ramp);

/// Makes the three parts of one planner, which fit each other only: the builder of the path, the
/// source of the limits inside its segments, and the planner of a window of segments.
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

/// Returns the parts of the planner that settings.planner names. Nothing else in the program asks
/// which planner is in use.
/// @param period  interpolation period, on which the limits of corners and chords depend [s]
std::unique_ptr<PlannerParts> make_planner(const Limits& limits, const PlanningModel& model,
                                           const PathSettings& settings, double period);

}  // namespace twin::feedrate

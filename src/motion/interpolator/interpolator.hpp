#pragma once

#include <cstdint>

#include "feedrate/profile/ramps.hpp"
#include "motion/interpolator/phase_clock.hpp"
#include "motion/interpolator/place_marker.hpp"
#include "motion/interpolator/set_point.hpp"
#include "motion/motion_settings.hpp"

namespace twin::motion {

/// Computes one set point for each interpolation period from the planned segments.
///
///   planned segments --> PhaseClock --> s, v, a at each instant --> PlaceMarker --> set points
///
/// Time runs through the phases of the planned segments without regard to where they end, so the
/// remainder of a period is carried from one segment into the next. Every period covers its full
/// distance, and the machining time is that of the plan, rounded up to a period. With
/// CurveEnd::kLand the remainder is lost at the end of every curve: a set point lies on each of
/// these ends, after a short step.
///
/// brake() leaves the plan and comes to rest on the same path as quickly as the limits allow. From
/// there the motion goes on by another plan, one that starts at the place of rest. arm() lets
/// another plan take over without a rest.
///
/// Every function is real-time safe if those of the source are.
class Interpolator {
 public:
  /// @param source  outlives the interpolator
  /// @param period  interpolation period T [s]
  Interpolator(SegmentSource& source, double period, const InterpolatorSettings& settings = {})
      : period_(period), clock_(source, settings.curve_end), marker_(settings.update) {}

  /// Computes the set point of the next period. The first one is the start of the path.
  /// @param out  gets the set point if the result is Status::kMoving; else it is left as it is
  Status step(SetPoint& out) noexcept {
    const Status status = clock_.advance(period_);
    if (status == Status::kMoving) {
      marker_.mark(clock_.segment(), clock_.instant(), period_, out);
    }
    return status;
  }

  /// Brakes on the path from the next period on, within these limits and those that the planner has
  /// given for braking on each segment.
  void brake(const feedrate::RampLimits& limits) noexcept { clock_.brake(limits); }
  bool is_braking() const noexcept { return clock_.is_braking(); }
  bool is_at_rest() const noexcept { return clock_.is_at_rest(); }

  /// Lets another plan take over at a place ahead.
  /// @returns false, with nothing changed, if the motion has passed the place or is braking
  bool arm(const PlanSwitch& at) noexcept { return clock_.arm(at); }
  /// At rest: chooses the plan to go on by, which must start at the place of rest.
  void adopt(std::int64_t plan) noexcept { clock_.adopt(plan); }
  /// At rest: goes on by the adopted plan.
  void resume() noexcept { clock_.resume(); }
  /// At rest: makes the place of rest the end of the path.
  void finish() noexcept { clock_.finish(); }

  bool has_started() const noexcept { return clock_.has_started(); }
  /// Where the motion is in its plan. The motion must have started.
  PlanPlace place() const noexcept { return clock_.place(); }
  /// The motion along the path: s from the start of the segment. The motion must have started.
  feedrate::PathMotion motion() const noexcept { return clock_.instant().motion; }
  /// Number of the plan that the present segment belongs to.
  std::int64_t plan() const noexcept { return clock_.plan(); }
  /// Number of the plan by which the path goes on: the armed or adopted one, else the present one.
  std::int64_t latest_plan() const noexcept { return clock_.latest_plan(); }
  /// Distance travelled from the start of the path [mm].
  double distance() const noexcept { return clock_.distance(); }
  /// Distance along the path that braking to rest would take from here [mm].
  double braking_distance(const feedrate::RampLimits& limits) const noexcept {
    return clock_.braking_distance(limits);
  }

 private:
  double period_;
  PhaseClock clock_;
  PlaceMarker marker_;
};

}  // namespace twin::motion

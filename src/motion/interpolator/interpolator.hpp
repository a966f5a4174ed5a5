#pragma once

#include <cstdint>

#include "feedrate/profile/ramps.hpp"
#include "motion/interpolator/phase_clock.hpp"
#include "motion/interpolator/place_marker.hpp"
#include "motion/interpolator/set_point.hpp"
#include "motion/motion_settings.hpp"

namespace twin::motion {

/// One set point per interpolation period.
///
///   planned segments --> PhaseClock --> s, v, a at each instant --> PlaceMarker --> set points
///
/// Time runs through the phases of the planned segments without regard to where they end, so the
/// remainder of a period is carried from one segment into the next. Every period covers its full
/// distance, and the machining time is that of the plan, rounded up to a period. With
/// CurveEnd::kLand the remainder is lost at the end of every curve: a set point lies on each of
/// these ends, after a short step.
///
/// brake() leaves the plan for the quickest way to rest on the same path; from there another plan,
/// made for a start at this place, goes on. arm() lets another plan take over in motion.
///
/// Every member is real-time safe if the source is.
class Interpolator {
 public:
  /// @param source  outlives the interpolator
  /// @param period  interpolation period T [s]
  Interpolator(SegmentSource& source, double period, const InterpolatorSettings& settings = {})
      : period_(period), clock_(source, settings.curve_end), marker_(settings.update) {}

  /// The set point of the next period; the first call gives the path's first place. On anything but
  /// Status::kMoving the set point is left as it is.
  Status step(SetPoint& out) noexcept {
    const Status status = clock_.advance(period_);
    if (status == Status::kMoving) {
      marker_.mark(clock_.segment(), clock_.instant(), period_, out);
    }
    return status;
  }

  /// From the next period on, brakes on the path, within these limits and those that the planner
  /// leaves for braking.
  void brake(const feedrate::RampLimits& limits) noexcept { clock_.brake(limits); }
  bool is_braking() const noexcept { return clock_.is_braking(); }
  bool is_at_rest() const noexcept { return clock_.is_at_rest(); }

  /// Lets another plan go on from a place ahead.
  /// @returns false, with nothing changed, if the place has been passed or the plan has been left
  bool arm(const PlanSwitch& at) noexcept { return clock_.arm(at); }
  /// At rest: another plan, which starts at this place, is the one to go on with.
  void adopt(std::int64_t plan) noexcept { clock_.adopt(plan); }
  /// At rest: goes on with the plan adopted.
  void resume() noexcept { clock_.resume(); }
  /// At rest: this place is the path's end.
  void finish() noexcept { clock_.finish(); }

  bool has_started() const noexcept { return clock_.has_started(); }
  /// Where the motion is; once it has started.
  PlanPlace place() const noexcept { return clock_.place(); }
  /// Number of the plan that the present segment is of.
  std::int64_t plan() const noexcept { return clock_.plan(); }
  /// Number of the plan that the rest of the path will be followed by.
  std::int64_t latest_plan() const noexcept { return clock_.latest_plan(); }
  /// Distance from the path's start [mm].
  double distance() const noexcept { return clock_.distance(); }
  /// Distance needed to come to rest from here [mm].
  double braking_distance(const feedrate::RampLimits& limits) const noexcept {
    return clock_.braking_distance(limits);
  }

 private:
  double period_;
  PhaseClock clock_;
  PlaceMarker marker_;
};

}  // namespace twin::motion

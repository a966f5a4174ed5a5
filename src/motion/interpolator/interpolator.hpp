#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "feedrate/planned_segment.hpp"
#include "feedrate/profile/phases.hpp"
#include "motion/interpolator/curve_follower.hpp"
#include "motion/interpolator/interpolator_settings.hpp"
#include "motion/interpolator/set_point.hpp"

namespace twin::motion {

/// Where the interpolator gets its segments from; called in the cycle.
class SegmentSource {
 public:
  SegmentSource() = default;
  SegmentSource(const SegmentSource&) = delete;
  SegmentSource& operator=(const SegmentSource&) = delete;
  virtual ~SegmentSource() = default;

  /// Next segment, or null when none is there yet or none will follow. Real-time safe.
  virtual const feedrate::PlannedSegment* next() noexcept = 0;
  /// Gives a segment back that next() handed out. Real-time safe.
  virtual void release(const feedrate::PlannedSegment* segment) noexcept = 0;
  /// Whether next() has handed out the last one. Real-time safe.
  virtual bool is_finished() const noexcept = 0;
  /// From now on next() hands out segments of this plan. Real-time safe.
  virtual void adopt(std::int64_t /*plan*/) noexcept {}
};

/// What a step found.
enum class Status : std::uint8_t {
  kMoving,   ///< a set point of the path
  kStarved,  ///< the next segment is not there yet: nothing has changed, ask again
  kAtRest,   ///< braked to rest on the path; adopt() and resume() go on
  kDone,     ///< the end of the path, reached by the step before
};

/// A place of the motion in its plan.
struct PlanPlace {
  std::int64_t segment = 0;  ///< index of the segment
  std::size_t phase = 0;     ///< of this segment in the plan; means nothing at rest
  double time = 0.0;         ///< into the phase [s]; means nothing at rest
  double s = 0.0;            ///< from the segment's start [mm]
};

/// Where one plan of the path ends and another goes on: the same place and feedrate in both, and no
/// tangential acceleration.
struct PlanSwitch {
  std::int64_t plan = 0;     ///< number of the plan that goes on
  std::int64_t segment = 0;  ///< index of the segment in which the present one ends
  std::size_t phase = 0;     ///< last phase of this segment that is followed
  double time = 0.0;         ///< into this phase [s]
};

/// One set point per interpolation period.
///
/// Time runs through the phases of the planned segments without regard to where they end, so the
/// remainder of a period is carried from one segment into the next: every period covers its full
/// distance, and the machining time is that of the plan, rounded up to a period. With
/// CurveEnd::kLand the remainder is lost at the end of every curve: a set point lies on each of
/// these ends, after a short step.
///
/// brake() leaves the plan for the quickest way to rest on the same path; from there another plan,
/// made for a start at this place, goes on. arm() lets another plan take over in motion.
class Interpolator {
 public:
  /// @param source  outlives the interpolator
  /// @param period  interpolation period T [s]
  Interpolator(SegmentSource& source, double period, const InterpolatorSettings& settings = {})
      : source_(source),
        period_(period),
        lands_(settings.curve_end == CurveEnd::kLand),
        follower_(settings.update) {}
  Interpolator(const Interpolator&) = delete;
  Interpolator& operator=(const Interpolator&) = delete;
  ~Interpolator();

  /// The set point of the next period; the first call gives the path's first place. Real-time safe.
  Status step(SetPoint& out) noexcept;

  /// From the next period on, brake on the path, within these limits and those that the planner
  /// leaves for braking. Real-time safe.
  void brake(const feedrate::RampLimits& limits) noexcept;
  bool is_braking() const noexcept { return mode_ == Mode::kBrake; }
  bool is_at_rest() const noexcept { return mode_ == Mode::kRest; }

  /// Lets another plan go on from a place ahead.
  /// @returns false, with nothing changed, if the place has been passed or the plan has been left.
  /// Real-time safe.
  bool arm(const PlanSwitch& at) noexcept;
  /// At rest: another plan, which starts at this place, is the one to go on with. Real-time safe.
  void adopt(std::int64_t plan) noexcept;
  /// At rest: goes on with the plan adopted. Real-time safe.
  void resume() noexcept;
  /// At rest: this place is the path's end. Real-time safe.
  void finish() noexcept;

  bool has_started() const noexcept { return current_ != nullptr; }
  /// Where the motion is; once it has started. Real-time safe.
  PlanPlace place() const noexcept;
  /// Number of the plan that the present segment is of.
  std::int64_t plan() const noexcept { return current_ == nullptr ? 0 : current_->plan; }
  /// Number of the plan that the rest of the path will be followed by.
  std::int64_t latest_plan() const noexcept { return armed_ ? armed_->plan : plan_; }
  /// Distance from the path's start [mm]. Real-time safe.
  double distance() const noexcept;
  /// Distance needed to come to rest from here [mm]. Real-time safe.
  double braking_distance(const feedrate::RampLimits& limits) const noexcept;

 private:
  enum class Mode : std::uint8_t { kPlan, kBrake, kRest };

  bool fetch() noexcept;
  bool ends_here() const noexcept { return armed_ && armed_->segment == current_->index; }
  void take_over() noexcept;
  bool lands_here() noexcept;
  Status advance_plan(double dt) noexcept;
  Status advance_brake(double dt) noexcept;
  feedrate::PathMotion motion() const noexcept;
  feedrate::Brake brake_from_here(feedrate::RampLimits limits) const noexcept;
  void put_place(SetPoint& out) noexcept;
  void mark_place(double s, SetPoint& out) noexcept;
  path::PathPoint locate(const feedrate::PathMotion& motion) noexcept;

  SegmentSource& source_;
  double period_;
  const feedrate::PlannedSegment* current_ = nullptr;
  Mode mode_ = Mode::kPlan;
  bool is_done_ = false;
  bool is_waiting_ = false;         // a step found no segment; its time is still in pending_
  std::size_t phase_ = 0;           // of the current segment
  double time_ = 0.0;               // since the start of the phase, or of braking [s]
  double pending_ = 0.0;            // time of this period that has not passed yet [s]
  feedrate::PathMotion between_{};  // at rest, or where a plan ended and the next has not begun yet
  double passed_ = 0.0;             // length of the segments before the current one [mm]
  std::int64_t plan_ = 0;
  bool is_between_ = false;  // the current segment is still one of the plan that was left
  std::optional<PlanSwitch> armed_;
  feedrate::Brake brake_{};  // s from the start of the current segment
  std::size_t mark_ = 0;     // block of the current segment
  std::size_t zone_ = 0;     // limit zone of the current segment
  double elapsed_ = 0.0;     // since the last set point or, if later, the segment's begin [s]
  bool lands_;               // on the ends of curves
  bool has_landed_ = false;  // the last set point is the end of the current curve
  CurveFollower follower_;
};

}  // namespace twin::motion

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "feedrate/planned_segment.hpp"
#include "feedrate/profile/phases.hpp"
#include "motion/motion_settings.hpp"

namespace twin::motion {

/// Where the interpolator gets its segments from; called in the cycle. Real-time safe on the wall
/// clock.
class SegmentSource {
 public:
  SegmentSource() = default;
  SegmentSource(const SegmentSource&) = delete;
  SegmentSource& operator=(const SegmentSource&) = delete;
  virtual ~SegmentSource() = default;

  /// Next segment, or null when none is there yet or none will follow.
  virtual const feedrate::PlannedSegment* next() noexcept = 0;
  /// Releases a segment that next() handed out; the first one first.
  virtual void release(const feedrate::PlannedSegment* segment) noexcept = 0;
  /// Whether next() has handed out the last one.
  virtual bool is_finished() const noexcept = 0;
  /// From now on next() hands out segments of this plan.
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

/// The motion at one instant, as far as the plan knows it.
struct PathInstant {
  feedrate::PathMotion motion;  ///< s from the segment's start
  double elapsed = 0.0;         ///< since the last instant or, if later, the segment's begin [s]
  bool is_curve_end = false;    ///< it lies on the end of a curve by CurveEnd::kLand
  bool is_braking = false;      ///< the plan was left for rest
};

/// Lets time pass along the phases of the planned segments, and takes segments from their source as
/// it goes.
///
///                         .--------------- fetch -----------------.
///                         v                                       |
///   idle --fetch--> following --place of the switch, take over--> between plans
///                      |  |                                       |   ^
///                    brake '--- path's end ---> ended           brake | resume
///                      v                                          |   |
///                   braking <-------------------------------------'   |
///                      |--- place of rest ---> at rest ---------------'
///                      '--- path's end ------> ended
///
/// Between plans the segment at hand is still one of the plan that was left. The next one fetched
/// is the same piece of path in the plan that goes on.
class PhaseClock {
 public:
  /// @param source  outlives the clock
  PhaseClock(SegmentSource& source, CurveEnd curve_end) : source_(source), curve_end_(curve_end) {}
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;
  ~PhaseClock();

  // Every member is real-time safe if the source is.

  /// Lets a period pass; the first call goes to the path's first place. @param period [s]
  Status advance(double period) noexcept;
  /// The instant that the last advance() came to.
  PathInstant instant() const noexcept;
  /// The segment that it is on; once the motion has started.
  const feedrate::PlannedSegment& segment() const noexcept { return *current_; }

  /// See Interpolator.
  void brake(const feedrate::RampLimits& limits) noexcept;
  bool arm(const PlanSwitch& at) noexcept;
  void adopt(std::int64_t plan) noexcept;
  void resume() noexcept;
  void finish() noexcept;

  bool is_braking() const noexcept { return state_ == State::kBraking; }
  bool is_at_rest() const noexcept { return state_ == State::kAtRest; }
  bool has_started() const noexcept { return current_ != nullptr; }
  std::int64_t plan() const noexcept { return current_ == nullptr ? 0 : current_->plan; }
  std::int64_t latest_plan() const noexcept { return armed_ ? armed_->plan : plan_; }
  PlanPlace place() const noexcept { return {current_->index, phase_, time_, motion().s}; }
  double distance() const noexcept { return current_ == nullptr ? 0.0 : passed_ + motion().s; }
  double braking_distance(const feedrate::RampLimits& limits) const noexcept {
    return current_ == nullptr ? 0.0 : brake_from_here(limits).distance;
  }

 private:
  enum class State : std::uint8_t {
    kIdle,           // nothing has been fetched
    kFollowing,      // in a phase of the plan
    kBetweenPlans,   // where a plan ended or the motion rested, before the next plan's segment
    kBraking,        // in a phase of the brake
    kAtRest,         // braked to rest on the path
    kEnded,          // at the path's end, by the plan
    kEndedByBraking  // at the path's end, or at a rest that is the end
  };

  bool fetch() noexcept;
  bool ends_here() const noexcept { return armed_ && armed_->segment == current_->index; }
  void take_over() noexcept;
  bool land() noexcept;
  bool pass_phases() noexcept;
  Status follow(double dt) noexcept;
  Status follow_brake(double dt) noexcept;
  Status end_or_starve(State end) noexcept;
  feedrate::PathMotion motion() const noexcept;
  feedrate::PathMotion motion_after_phases() const noexcept;
  feedrate::Brake brake_from_here(feedrate::RampLimits limits) const noexcept;

  SegmentSource& source_;
  CurveEnd curve_end_;
  State state_ = State::kIdle;
  const feedrate::PlannedSegment* current_ = nullptr;
  std::size_t phase_ = 0;         // of the current segment
  double time_ = 0.0;             // since the start of the phase, or of braking [s]
  double pending_ = 0.0;          // time of this period that has not passed yet [s]
  bool has_starved_ = false;      // the last call found no segment; its time is in pending_
  double elapsed_ = 0.0;          // since the last instant or, if later, the segment's begin [s]
  feedrate::PathMotion stand_{};  // between plans and at rest
  double passed_ = 0.0;           // length of the segments before the current one [mm]
  std::int64_t plan_ = 0;
  std::optional<PlanSwitch> armed_;
  feedrate::Brake brake_{};       // s from the start of the current segment
  bool is_on_curve_end_ = false;  // the last instant is the end of the current curve
};

}  // namespace twin::motion

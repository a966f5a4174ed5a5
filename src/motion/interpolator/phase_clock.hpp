#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
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

/// Result of letting one period pass.
enum class Status : std::uint8_t {
  kMoving,   ///< there is a new set point
  kStarved,  ///< the next segment is not planned yet; call again to go on where the motion is
  kAtRest,   ///< the motion has braked to rest on the path; adopt() and resume() let it go on
  kDone,     ///< the call before has reached the end of the path
};

/// Where the motion is in its plan. After braking to rest, phase and time are undefined.
struct PlanPlace {
  std::int64_t segment = 0;  ///< index of the segment
  std::size_t phase = 0;     ///< index of the phase within the segment
  double time = 0.0;         ///< time since the begin of the phase [s]
  double s = 0.0;            ///< distance from the start of the segment [mm]
};

/// Where the motion changes from one plan of the path to another. Both plans have the same place
/// and feedrate there, and no tangential acceleration.
struct PlanSwitch {
  std::int64_t plan = 0;     ///< number of the plan that takes over
  std::int64_t segment = 0;  ///< index of the segment in which the present plan is left
  std::size_t phase = 0;     ///< index of the last phase of this segment that is followed
  double time = 0.0;         ///< time since the begin of this phase at which it is left [s]
  double distance = std::numeric_limits<double>::infinity();  ///< from the start of the path [mm]
};

/// The motion at one instant, as far as the plan knows it.
struct PathInstant {
  feedrate::PathMotion motion;  ///< its s is the distance from the start of the segment
  double elapsed = 0.0;         ///< since the last instant or, if later, the segment's begin [s]
  bool is_curve_end = false;    ///< the instant lies on the end of a curve, by CurveEnd::kLand
  bool is_braking = false;      ///< the motion has left the plan and brakes to rest
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
/// Between plans the current segment still belongs to the plan that was left. The next fetched
/// segment is the same part of the path in the plan that takes over.
class PhaseClock {
 public:
  /// @param source  outlives the clock
  PhaseClock(SegmentSource& source, CurveEnd curve_end) : source_(source), curve_end_(curve_end) {}
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;
  ~PhaseClock();

  // Every member is real-time safe if the source is.

  /// Lets one period pass. The first call goes to the start of the path.
  /// @param period  [s]
  Status advance(double period) noexcept;
  /// The motion at the end of the last advance().
  PathInstant instant() const noexcept;
  /// The current segment. The motion must have started.
  const feedrate::PlannedSegment& segment() const noexcept { return *current_; }

  // The following functions are those of Interpolator, which explains them.

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
  double braking_distance(const feedrate::RampLimits& limits) const noexcept;

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
  feedrate::Stretch stretch_at(double s, const feedrate::RampLimits& limits) const noexcept;
  std::optional<feedrate::Brake> stop_nearby(const feedrate::PathMotion& from,
                                             const feedrate::Stretch& stretch,
                                             const feedrate::RampLimits& limits) const noexcept;
  feedrate::StopPart stop_part(const feedrate::PathMotion& from,
                               const feedrate::RampLimits& limits) const noexcept;
  void begin_stop_part(const feedrate::PathMotion& from) noexcept;
  bool cross_segments() noexcept;
  bool go_on_braking() noexcept;

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
  feedrate::RampLimits brake_limits_{};  // of the machine
  feedrate::Brake brake_{};       // part of the stop; s from the start of the current segment
  bool rests_ = false;            // it ends at rest
  bool is_on_curve_end_ = false;  // the last instant is the end of the current curve
};

}  // namespace twin::motion

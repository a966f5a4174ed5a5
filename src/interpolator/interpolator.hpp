#pragma once

#include <cstddef>
#include <cstdint>

#include "feedrate/brake.hpp"
#include "feedrate/planned_segment.hpp"
#include "interpolator/curve_follower.hpp"
#include "interpolator/set_point.hpp"
#include "interpolator/settings.hpp"

namespace twin::interpolator {

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
};

/// What a step found.
enum class Status : std::uint8_t {
  kMoving,   ///< a set point of the path
  kStarved,  ///< the next segment is not there yet: nothing has changed, ask again
  kAtRest,   ///< braked to rest on the path; resume() goes on
  kDone,     ///< the end of the path, reached by the step before
};

/// One set point per interpolation period.
///
/// Time runs through the phases of the planned segments without regard to where they end, so the
/// remainder of a period is carried from one segment into the next: every period covers its full
/// distance, and the machining time is that of the plan, rounded up to a period. With
/// CurveEnd::kLand the remainder is lost at the end of every curve: a set point lies on each of
/// these ends, after a short step.
///
/// brake() leaves the plan for the quickest way to rest on the same path. resume() returns to it:
/// the plan's time then runs at a rate that grows smoothly from 0 to 1, so no limit of the plan is
/// exceeded by more than the rate's own small change.
class Interpolator {
 public:
  /// @param source  outlives the interpolator
  /// @param period  interpolation period T [s]
  Interpolator(SegmentSource& source, double period, const Settings& settings = {})
      : source_(source),
        period_(period),
        lands_(settings.curve_end == CurveEnd::kLand),
        follower_(settings.update) {}
  Interpolator(const Interpolator&) = delete;
  Interpolator& operator=(const Interpolator&) = delete;
  ~Interpolator();

  /// The set point of the next period; the first call gives the path's first place. Real-time safe.
  Status step(SetPoint& out) noexcept;

  /// From the next period on, brake on the path. Real-time safe.
  void brake(const feedrate::RampLimits& limits) noexcept;
  /// After kAtRest: back to the plan. Real-time safe.
  void resume() noexcept;
  bool is_braking() const noexcept { return mode_ == Mode::kBrake; }

  /// Distance needed to come to rest from here [mm]. Real-time safe.
  double braking_distance(const feedrate::RampLimits& limits) const noexcept;
  /// Length of the current segment that is still ahead [mm]. Real-time safe.
  double remaining_in_segment() const noexcept;

 private:
  enum class Mode : std::uint8_t { kPlan, kBrake, kRest };

  bool fetch() noexcept;
  bool lands_here() noexcept;
  Status advance_plan(double dt) noexcept;
  Status advance_brake(double dt) noexcept;
  feedrate::PathMotion motion() const noexcept;
  void rejoin_plan() noexcept;
  void place(SetPoint& out) noexcept;
  void mark_place(double s, SetPoint& out) noexcept;
  path::PathPoint locate(const feedrate::PathMotion& motion) noexcept;

  SegmentSource& source_;
  double period_;
  const feedrate::PlannedSegment* current_ = nullptr;
  Mode mode_ = Mode::kPlan;
  bool is_done_ = false;
  bool is_waiting_ = false;   // a step found no segment; its time is still in pending_
  std::size_t phase_ = 0;     // of the current segment
  double time_ = 0.0;         // since the start of the phase, or of braking [s]
  double pending_ = 0.0;      // time of this period that has not passed yet [s]
  double rate_time_ = -1.0;   // time since resume() [s]; negative: the plan runs at full rate
  double rate_ = 1.0;         // rate of the plan's time
  double rate_change_ = 0.0;  // its derivative [1/s]
  feedrate::Brake brake_{};   // s from the start of the current segment
  std::size_t mark_ = 0;      // block of the current segment
  std::size_t zone_ = 0;      // limit zone of the current segment
  double elapsed_ = 0.0;      // since the last set point or, if later, the segment's begin [s]
  bool lands_;                // on the ends of curves
  bool has_landed_ = false;   // the last set point is the end of the current curve
  CurveFollower follower_;
};

}  // namespace twin::interpolator

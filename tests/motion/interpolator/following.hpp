#pragma once

#include <deque>
#include <vector>

#include "motion/interpolator/interpolator.hpp"
#include "tests/support/plan.hpp"

namespace twin::test {

/// Hands out the segments of a finished plan; now and then, if told so, none is there yet.
class PlanSource final : public motion::SegmentSource {
 public:
  explicit PlanSource(const Plan& plan, std::size_t starve_every = 0)
      : plan_(plan), starve_every_(starve_every) {}

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* segment) noexcept override;
  bool is_finished() const noexcept override { return next_ == plan_.segments.size(); }

  std::size_t released() const { return released_; }

 private:
  const Plan& plan_;
  std::size_t starve_every_;
  std::size_t asked_ = 0;
  std::size_t next_ = 0;
  std::size_t released_ = 0;
};

/// Hands out a plan, and others of the same path that start inside it, one after the other.
class ReplanSource final : public motion::SegmentSource {
 public:
  /// @param scale  of the programmed feedrates of the other plans [-]
  ReplanSource(const Plan& plan, double period, double scale = 1.0);

  /// Plans the path again from a place passed with no acceleration; adopt() switches to it.
  /// @returns its number
  std::int64_t plan_from(std::int64_t segment, double s, double v);

  const feedrate::PlannedSegment* next() noexcept override;
  void release(const feedrate::PlannedSegment* /*segment*/) noexcept override {}
  bool is_finished() const noexcept override { return next_ == segments().size(); }
  void adopt(std::int64_t plan) noexcept override;

 private:
  const std::vector<feedrate::PlannedSegment>& segments() const {
    return plans_[static_cast<std::size_t>(plan_)];
  }

  double period_;
  double scale_;
  std::vector<path::Segment> path_;
  std::deque<std::vector<feedrate::PlannedSegment>> plans_;
  std::int64_t plan_ = 0;
  std::size_t next_ = 0;
};

/// All set points of a plan.
std::vector<motion::SetPoint> follow(const Plan& plan, double period, std::size_t starve_every = 0,
                                     const motion::InterpolatorSettings& settings = {});

/// Place of the path at a time of the plan, found without the interpolator [mm].
Vec3 place_at(const Plan& plan, double time);

/// Place of the path at a distance from its start [mm].
Vec3 place_at_distance(const Plan& plan, double distance);

/// Distance from the path's start at a time of the plan [mm].
double distance_at(const Plan& plan, double time);

/// A smooth outline in curves, with tight and wide rounds.
Plan smooth_plan(double period);

/// Lines, an arc, curves, a corner, an exact stop and a dwell.
Plan mixed_plan(double period);

}  // namespace twin::test

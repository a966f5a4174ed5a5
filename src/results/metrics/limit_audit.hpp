#pragma once

#include <array>
#include <cstddef>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "results/metrics/arc_steps.hpp"

namespace twin::results {

/// Peaks of one axis.
struct AxisPeaks {
  double velocity = 0.0;      ///< [mm/s]
  double acceleration = 0.0;  ///< [mm/s^2]
  double jerk = 0.0;          ///< [mm/s^3]
};

/// Largest absolute values over a trajectory.
struct AuditPeaks {
  double feedrate = 0.0;                 ///< [mm/s]
  double tangential_acceleration = 0.0;  ///< [mm/s^2]
  double tangential_jerk = 0.0;          ///< [mm/s^3]
  double normal_acceleration = 0.0;      ///< [mm/s^2]
  std::array<AxisPeaks, 3> axis;         ///< x, y, z
};

/// Peaks of feedrate, acceleration and jerk of a trajectory, computed from its set points alone as
/// they arrive, in constant memory.
///
/// The audit does not use any number of the planner. It takes the machine to be at rest before the
/// first and after the last set point, so a trajectory that does not start or end at rest shows.
///
/// Differences can be trusted for this reason: the m-step difference of order k of a function f,
/// divided by (m T)^k, is a weighted mean of the k-th derivative of f. The weight is a B-spline over
/// k m T, which is positive and has area 1. For one axis, and for the arc length along the path, the
/// difference therefore never exceeds the true peak; a step of jerk inside a period is averaged.
///
/// For the axes, f is x, y or z and m = 1. Along the path, f is the arc length of ArcSteps. It is
/// known in each period only up to a doubt u, so that a difference of order 2 or 3 is in doubt by
///   e_2 = (U + U') / (m T)^2,   e_3 = (U + 2 U' + U'') / (m T)^3                     (1)
/// where U, U', U'' are the sums of u over the runs of m periods that enter the difference. At each
/// instant the smallest m of 1, 2, 4, 8, 16 is used whose e is below 5 % of the limit, or m = 16 if
/// there is none. So a corner or a step of curvature raises no false alarm, and nothing is smeared
/// where the path is smooth.
///
/// The normal acceleration is the part of the plain second difference that is square to
/// p_(i+1) - p_(i-1). A factor 1 + x^2 / 12 makes up for averaging over a bend of x per period.
class LimitAudit {
 public:
  /// @param period  interpolation period T > 0 [s]
  /// @param limits  a doubt is small against the acceleration and jerk of these
  LimitAudit(double period, const Limits& limits);

  /// Takes the next set point [mm]. Real-time safe.
  void add(const Vec3& point) noexcept;

  /// Peaks up to now; after finish() those of the whole trajectory.
  const AuditPeaks& peaks() const noexcept { return peaks_; }

  /// Lets the machine rest after the last set point and returns the peaks.
  const AuditPeaks& finish() noexcept;

 private:
  static constexpr std::size_t kLargestScale = 16;
  static constexpr std::size_t kWindow = 3 * kLargestScale;  // periods looked at together
  static constexpr std::size_t kPlace = (kWindow - 3) / 2;   // the one in the window that is judged

  void judge_axes() noexcept;
  void judge_normal(const Step& before, const Step& after) noexcept;
  double along_path(std::size_t order, double limit) const noexcept;

  double period_;  // T [s]
  double acceleration_limit_;
  double jerk_limit_;
  bool has_started_ = false;
  std::array<Vec3, 5> points_{};  // latest first [mm]
  ArcSteps arc_steps_;
  std::array<Step, kWindow> steps_{};  // oldest first
  AuditPeaks peaks_;
};

}  // namespace twin::results

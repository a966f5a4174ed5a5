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

/// Feedrate, acceleration and jerk of a trajectory from its set points alone, as they come, in
/// constant memory.
///
/// The planner's own numbers are not asked. Before the first and after the last set point the
/// machine is at rest, so a trajectory that does not start and end at rest shows.
///
/// Why differences may be trusted: the m-step difference of order k of a function f over (m T)^k is
/// the mean of its k-th derivative, weighted by a B-spline over k m T that is positive and has
/// area 1. For one axis, and for the arc length along the path, it therefore never exceeds the true
/// peak; a step of jerk inside a period is averaged.
///
/// Per axis f = x, y, z with m = 1. Along the path f is the arc length of ArcSteps, each period of
/// which carries a doubt u; a difference of order 2 or 3 then carries
///   e_2 = (U + U') / (m T)^2,   e_3 = (U + 2 U' + U'') / (m T)^3                     (1)
/// with U, U', U'' the sums of u over its runs of m periods. At each place the smallest m of 1, 2,
/// 4, 8, 16 counts whose e is below 5 % of the limit, or m = 16 if none is: a corner or a step of
/// curvature does not cry wolf, and on smooth path nothing is smeared.
///
/// Normal acceleration: the part of the plain second difference that is square to p_(i+1) -
/// p_(i-1), times 1 + x^2 / 12 for the mean over a bend of x per period.
class LimitAudit {
 public:
  /// @param period  interpolation period T > 0 [s]
  /// @param limits  acceleration and jerk set what doubt is small
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

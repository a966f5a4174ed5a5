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

/// Computes the peaks of feedrate, acceleration and jerk of a trajectory from its set points alone,
/// as they arrive and in constant memory.
///
/// The audit does not use any number of the planner. It takes the machine to be at rest before the
/// first and after the last set point. So a trajectory that does not start or end at rest has a
/// visible peak there.
///
/// Differences never exceed the true peak, for this reason: the difference of order k of a function
/// f over steps of m periods, divided by (m T)^k, is a weighted mean of the k-th derivative of f.
/// The weight is a B-spline over the time k m T, which is positive and has area 1. A step of jerk
/// inside a period is averaged.
///
/// For the axes, f is x, y or z, and m = 1. Along the path, f is the arc length of ArcSteps, which
/// is known in each period only up to a doubt u. A difference of order 2 or 3 is then in doubt by
///   e_2 = (U + U') / (m T)^2,   e_3 = (U + 2 U' + U'') / (m T)^3                     (1)
/// where U, U', U'' are the sums of u over the runs of m periods that enter the difference. A
/// larger m makes the doubt smaller, but averages over a longer time. At each instant the audit
/// uses the smallest m of 1, 2, 4, 8, 16 whose doubt is below 5 % of the limit. If there is none, as
/// among corners a few periods apart, it takes what is certain at m = 16, the difference less its
/// doubt. So a corner or a step of curvature raises no false alarm, and a smooth path is not
/// averaged more than it must be.
///
/// The normal acceleration is the component of the plain second difference that is perpendicular to
/// p_(i+1) - p_(i-1). The factor 1 + x^2 / 12 corrects the averaging over a bend of angle x per
/// period.
class LimitAudit {
 public:
  /// @param period  interpolation period T > 0 [s]
  /// @param limits  acceleration and jerk against which a doubt is judged
  LimitAudit(double period, const Limits& limits);

  /// Takes the next set point [mm]. Real-time safe.
  void add(const Vec3& point) noexcept;

  /// Peaks so far; after finish() those of the whole trajectory.
  const AuditPeaks& peaks() const noexcept { return peaks_; }

  /// Ends the trajectory, with the machine at rest after the last set point, and returns the peaks.
  const AuditPeaks& finish() noexcept;

 private:
  static constexpr std::size_t kLargestScale = 16;
  static constexpr std::size_t kWindow = 3 * kLargestScale;  // periods in memory
  static constexpr std::size_t kPlace = (kWindow - 3) / 2;   // index of the period that is judged

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

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "results/metrics/arc_steps.hpp"

namespace twin::results {

/// Something of each quantity that the audit judges of one axis.
template <class T>
struct OfEachAxisPeak {
  T velocity{};      ///< [mm/s]
  T acceleration{};  ///< [mm/s^2]
  T jerk{};          ///< [mm/s^3]
};

/// Something of each quantity that the audit judges.
template <class T>
struct OfEachPeak {
  T feedrate{};                             ///< [mm/s]
  T tangential_acceleration{};              ///< [mm/s^2]
  T tangential_jerk{};                      ///< [mm/s^3]
  T normal_acceleration{};                  ///< [mm/s^2]
  T vector_jerk{};                          ///< of x, y and z together [mm/s^3]
  std::array<OfEachAxisPeak<T>, 3> axis{};  ///< x, y, z
};

/// Calls a function with the members of some OfEachPeak that belong to the same quantity.
template <class Call, class... Peaks>
constexpr void for_each_peak(Call&& call, Peaks&... peaks) {
  call(peaks.feedrate...);
  call(peaks.tangential_acceleration...);
  call(peaks.tangential_jerk...);
  call(peaks.normal_acceleration...);
  call(peaks.vector_jerk...);
  for (std::size_t i = 0; i < 3; ++i) {
    call(peaks.axis[i].velocity...);
    call(peaks.axis[i].acceleration...);
    call(peaks.axis[i].jerk...);
  }
}

/// Largest absolute values over a trajectory.
using AxisPeaks = OfEachAxisPeak<double>;
using AuditPeaks = OfEachPeak<double>;

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

  /// Number of the set point, from 0, about which each peak was found. A difference of several set
  /// points counts for the one in its middle. At most kOldest set points before the latest when it
  /// changes. After finish() a number may be beyond the last set point.
  const OfEachPeak<std::int64_t>& where() const noexcept { return where_; }

  /// Ends the trajectory, with the machine at rest after the last set point, and returns the peaks.
  const AuditPeaks& finish() noexcept;

  /// Begins the peaks anew, with everything that is known of the trajectory. So the peaks of one
  /// stretch after the other can be had. Real-time safe.
  void forget_peaks() noexcept {
    peaks_ = {};
    where_ = {};
  }

  /// Set points from the latest one back to the oldest that where() can name anew.
  static constexpr std::int64_t kOldest = 32;

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
  std::int64_t latest_ = -1;  // number of the latest set point
  OfEachPeak<std::int64_t> where_;
};

}  // namespace twin::results

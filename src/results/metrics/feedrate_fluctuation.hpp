#pragma once

#include <array>
#include <optional>

#include "core/vec.hpp"
#include "results/metrics/arc_steps.hpp"
#include "results/metrics/running.hpp"

namespace twin::results {

/// How far the feedrate that the set points really have is off the commanded one, as a share of the
/// commanded one:  |V_true - V| / V  of every period.
///
/// V_true is the way of a period, from ArcSteps, over the period. V is the mean over the period of
/// the commanded feedrate, of the cubic through four successive set points:
///   (v_1 + v_2)/2 - (v_3 - v_2 - v_1 + v_0)/24.
/// Neither is known better than the set points tell: the way is in doubt where the curvature
/// changes within a period (ArcSteps), V where the jerk does, by a twelfth of the third difference
/// of v there or in a period beside. What lies within the sum of both counts as none. Periods
/// slower than 1 mm/s are left out, and those whose way is in doubt by more than itself: across a
/// corner the chord says nothing of the way.
class FeedrateFluctuation {
 public:
  /// @param period  interpolation period T > 0 [s]
  explicit FeedrateFluctuation(double period) : period_(period) {}

  /// add() number n completes the period from set point n - kDelay to the next.
  static constexpr int kDelay = 4;

  /// Takes the next set point [mm] and its feedrate [mm/s].
  /// @returns the share of the period it completes; nothing where that is left out
  /// @note Real-time safe.
  std::optional<double> add(const Vec3& point, double feedrate) noexcept;

  /// The shares [-]; 0.01 is 1 %.
  const Running& shares() const noexcept { return shares_; }

 private:
  double period_;
  int count_ = 0;
  ArcSteps steps_;
  Step step_;                          // from set point n - 4 to n - 3, once n is there
  std::array<double, 7> feedrates_{};  // of set points n - 6 to n [mm/s]
  Running shares_;
};

}  // namespace twin::results

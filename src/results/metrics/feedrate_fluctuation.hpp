#pragma once

#include <array>
#include <optional>

#include "core/vec.hpp"
#include "results/metrics/arc_steps.hpp"
#include "results/metrics/running.hpp"

namespace twin::results {

/// Relative error of the feedrate in every period:  |V_true - V| / V.
///
/// V_true is the feedrate that the set points really have: the length of path covered in a period,
/// from ArcSteps, divided by the period. V is the mean of the commanded feedrate over the period.
/// It is taken from the cubic through four successive set points:
///   V = (v_1 + v_2)/2 - (v_3 - v_2 - v_1 + v_0)/24.
///
/// The set points determine both values only up to a doubt. The length is in doubt where the
/// curvature changes within a period (see ArcSteps). V is in doubt where the jerk changes, by a
/// twelfth of the largest third difference of v in this period and its neighbours. An error within
/// the sum of the two doubts counts as zero.
///
/// Two kinds of periods are left out: periods slower than 1 mm/s, and periods whose length is in
/// doubt by more than the chord itself, as across a corner.
class FeedrateFluctuation {
 public:
  /// @param period  interpolation period T > 0 [s]
  explicit FeedrateFluctuation(double period) : period_(period) {}

  /// add() with set point n returns the error of the period from set point n - kDelay to the next.
  static constexpr int kDelay = 4;

  /// Takes the next set point [mm] and its feedrate [mm/s].
  /// @returns the relative error of the period that is complete now [-]; nothing if it is left out
  /// @note Real-time safe.
  std::optional<double> add(const Vec3& point, double feedrate) noexcept;

  /// Statistics of the relative errors so far [-]; 0.01 is 1 %.
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

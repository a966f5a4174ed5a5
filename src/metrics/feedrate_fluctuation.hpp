#pragma once

#include <array>

#include "core/vec.hpp"
#include "metrics/running.hpp"

namespace twin::metrics {

/// How far the feedrate that the set points really have is off the commanded one, as a share of the
/// commanded one:  |V_true - V| / V  of every period.
///
/// V_true is the way of a period over the period. The way is the chord from set point to set point,
/// longer by x^2/24 for a bend of x rad (mean of the turns at its two ends). V is the mean over the
/// period of the commanded feedrate, of the cubic through four successive set points:
///   (v_1 + v_2)/2 - (v_3 - v_2 - v_1 + v_0)/24.
/// Both leave out terms of fourth order in the period. Periods slower than 1 mm/s are not counted,
/// nor those that begin or end at a turn of more than 0.3 rad: across a corner the chord says
/// nothing of the way.
class FeedrateFluctuation {
 public:
  /// @param period  interpolation period T > 0 [s]
  explicit FeedrateFluctuation(double period) : period_(period) {}

  /// Takes the next set point [mm] and its feedrate [mm/s]. Real-time safe.
  void add(const Vec3& point, double feedrate) noexcept;

  /// The shares [-]; 0.01 is 1 %.
  const Running& shares() const noexcept { return shares_; }

 private:
  double period_;
  int count_ = 0;
  std::array<Vec3, 4> points_{};       // oldest first [mm]
  std::array<double, 4> feedrates_{};  // [mm/s]
  Running shares_;
};

}  // namespace twin::metrics

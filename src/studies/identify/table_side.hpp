#pragma once

#include <Eigen/Core>

#include "studies/identify/axis_record.hpp"

namespace twin::studies::identify {

/// Drops what is slower than a time constant, the first value, and rows that do not count.
///
/// With the time constant tau and the period T, y_k = exp(-T / tau) (y_{k-1} + x_k - x_{k-1}).
/// @param first   row before which everything is 0
void drop_slow(Eigen::Ref<Eigen::VectorXd> values, const AxisRecord& record, double period,
               double time_constant, std::size_t first);

/// Velocity by a central difference of the measured positions over some rows [mm/s]. The set points'
/// is no measure of it: what the axis lags behind by goes with the acceleration, as stretch does.
double measured_velocity(const AxisRecord& record, std::size_t row, double period);

/// Residuals of the table's position that the screw answers for.
///
/// A scale on the table differs from the motor's encoder by more than stretch and play of the screw:
/// the lead is not exact (a share of the position), and the two are read at other instants (a share
/// of the velocity). Both shares are taken off a residual by projection, so that no parameter of the
/// screw makes up for them. Until the axis has moved by kFirstWay it is not known at which flank the
/// nut stands; these rows are 0.
class TableSide {
 public:
  static constexpr double kFirstWay = 0.5;  ///< [mm]

  /// @param takes_shares_off  whether the motor's encoder tells of the same motion
  TableSide(const AxisRecord& record, double period, double time_constant, bool takes_shares_off);

  /// Makes a residual of measured less simulated position of the table [mm].
  void take(Eigen::Ref<Eigen::VectorXd> apart, const AxisRecord& record) const;

 private:
  double period_;
  double time_constant_;
  std::size_t first_;
  Eigen::MatrixXd shares_;  // orthonormal columns, or none
};

}  // namespace twin::studies::identify

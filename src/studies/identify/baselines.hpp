#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "studies/identify/axis_record.hpp"

/// Models without physics that a prediction must beat.
namespace twin::studies::identify {

/// The delay d for which measured(t) is nearest to command(t - d) over records [s].
double fit_delay(std::span<const AxisRecord> records, double period);
/// Positions command(t - d) at the rows of a record [mm].
std::vector<double> delayed_command(const AxisRecord& record, double period, double delay);

/// Taps of the linear filter
///   y_k = r_k + sum_{i=1}^{10} c_i (r_{k-i} - r_k)
/// of the set points, by least squares over records; at rest it is where the set point is.
Eigen::VectorXd fit_taps(std::span<const AxisRecord> records);
/// Positions by such a filter [mm].
std::vector<double> filtered_command(const AxisRecord& record, const Eigen::VectorXd& taps);

}  // namespace twin::studies::identify

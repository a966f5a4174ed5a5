#pragma once

#include "core/limits.hpp"

namespace twin::feedrate {

/// Corner feedrate of the servo model: V = Kp/(1 - Kf) eps_max / cos(theta / 2).          [WY, Eq.
/// 16]
///
/// @param turn  change of direction pi - theta, 0 <= turn <= pi [rad]
/// @returns [mm/s]; infinity for a straight passage
double corner_model_feedrate(double turn, double corner_error, const PlanningModel& model) noexcept;

/// Feedrate at which the velocity vector changes by A T within the period that holds the corner.
///
/// The corner changes it by 2 v sin(turn / 2), the bend beside it, of curvature kappa, by up to
/// kappa v^2 T:
///   kappa T v^2 + 2 sin(turn / 2) v = A T.
///
/// @param turn       change of direction at the corner [rad]
/// @param curvature  larger curvature of the path on either side [1/mm]
/// @param period     interpolation period T [s]
double corner_acceleration_feedrate(double turn, double curvature, double acceleration,
                                    double period) noexcept;

}  // namespace twin::feedrate

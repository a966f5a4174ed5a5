#pragma once

#include "core/limits.hpp"

namespace twin::feedrate {

/// Curvature up to which the programmed feedrate V may stay: kappa_critical = a / V^2.
///   [WY09, Eq. 2]
double critical_curvature(double acceleration, double feedrate) noexcept;

/// Feedrate at which the servo model's circular contouring error just reaches its tolerance.
///
/// A first-order loop with feedforward, gains Kp and Kf, follows a circle of curvature kappa at
/// angular velocity w on a radius that is too small by eps:
///   kappa eps = 1 - sqrt((Kf^2 w^2 + Kp^2) / (w^2 + Kp^2))
///   [WY09, Eq. 3]
/// which for w gives
///   w = Kp sqrt((1 - (1 - kappa eps)^2) / ((1 - kappa eps)^2 - Kf^2)),  V = w / kappa
///   [WY09, Eqs. 4, 5]
/// For 1 - kappa eps <= Kf the model keeps the tolerance at any speed.
///
/// @param curvature  kappa > 0 [1/mm]
/// @returns feedrate limit [mm/s], infinity where the model sets none
double servo_model_feedrate(double curvature, const PlanningModel& model) noexcept;

/// Feedrate limit at a place of a curve: the programmed feedrate, from the critical curvature on
/// Eq. 5 (that is Eq. 6), and never more than the normal acceleration kappa v^2 <= A_max allows.
///
/// @param curvature  kappa >= 0 [1/mm]
/// @param feedrate   programmed feedrate V > 0 [mm/s]
double curvature_feedrate(double curvature, double feedrate, const PlanningModel& model,
                          const Limits& limits) noexcept;

}  // namespace twin::feedrate

#pragma once

#include "core/limits.hpp"

namespace twin::feedrate {

/// Corner feedrate of the servo model: V = Kp/(1 - Kf) eps_max / cos(theta / 2).
///   [WY09, Eq. 16]
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

/// Feedrate at which a corner between two set points does not look like jerk.
///
/// The chord across the corner is shorter than the way by up to v T turn^2 / 8, depending on where
/// in the period the corner falls. A corner by itself can be told from a change of feedrate; one of
/// several in a few periods, or one beside a bend, cannot: there the set points' own third
/// difference, up to four times that over T^3, must stay small:
///   v turn^2 / (2 T^2) <= kRipple J.
///
/// @param jerk  J_max [mm/s^3]
/// @returns [mm/s]; infinity for no turn
double corner_ripple_feedrate(double turn, double jerk, double period) noexcept;

/// A corner that turns by more than this stands out of any bend, even where the two set points
/// beside it share its turn [rad].
inline constexpr double kSharpTurn = 1.4;

/// Periods around a corner in which another turn hides it.
inline constexpr double kHidingPeriods = 3.5;

/// Share of a corner's turn that hides it.
inline constexpr double kHidingShare = 0.125;

/// How far before a corner lie those whose limits it may lower, at most [mm].
/// @param feedrate  the largest one that the machine accepts [mm/s]
/// @param period    interpolation period [s]
constexpr double corner_reach(double feedrate, double period) noexcept {
  return kHidingPeriods * feedrate * period;
}

}  // namespace twin::feedrate

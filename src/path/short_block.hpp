#pragma once

#include "core/limits.hpp"
#include "core/vec.hpp"

namespace twin::path {

/// Corner angle from which on two blocks may be joined by a curve at a feedrate V:
///   theta_critical = 2 acos(Kp / (1 - Kf) eps_max / V)                                  [WY09, Eq.
///   1]
/// Where V is so small that the argument exceeds 1, every corner passes: 0.
///
/// @param corner_error  eps_max [mm]
/// @param feedrate      V > 0 [mm/s]
/// @returns corner angle in [0, pi], pi is straight on [rad]
double critical_corner_angle(double feedrate, double corner_error, const PlanningModel& model);

/// Corner angle theta at p1 between the blocks p0 p1 and p1 p2; pi is straight on [rad].
double corner_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2);

/// Larger of the two sagittas of the circle through three successive points over their chords: the
/// bi-chord test's delta_1, delta_2 (Fig. 4 of the paper). Infinite where the path turns by 90 deg
/// or more [mm].
double bi_chord_error(const Vec3& p0, const Vec3& p1, const Vec3& p2);

}  // namespace twin::path

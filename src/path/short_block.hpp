#pragma once

#include "core/limits.hpp"
#include "core/vec.hpp"

namespace twin::path {

/// Smallest corner angle at which a curve may join two blocks at a feedrate V [WY09, Eq. 1]:
///   theta_critical = 2 acos(Kp / (1 - Kf) eps_max / V).
/// Where V is so small that the argument exceeds 1, the angle is 0: a curve may join any two
/// blocks.
///
/// @param corner_error  eps_max [mm]
/// @param feedrate      V > 0 [mm/s]
/// @returns corner angle in [0, pi], pi is straight on [rad]
double critical_corner_angle(double feedrate, double corner_error, const PlanningModel& model);

/// Corner angle theta at p1 between the blocks p0 p1 and p1 p2; pi is straight on [rad].
double corner_angle(const Vec3& p0, const Vec3& p1, const Vec3& p2);

/// Larger of the two sagittas, over its two chords, of the circle through three successive points
/// [mm]: delta_1 and delta_2 of the bi-chord test [WY09, Fig. 4]. Infinite where the path turns by
/// 90 deg or more.
double bi_chord_error(const Vec3& p0, const Vec3& p1, const Vec3& p2);

/// Whether bi_chord_error() is at most `tolerance` [mm]. Where it is plainly less, no root is taken.
bool is_bi_chord_within(const Vec3& p0, const Vec3& p1, const Vec3& p2, double tolerance);

}  // namespace twin::path

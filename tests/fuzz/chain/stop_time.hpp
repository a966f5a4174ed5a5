#pragma once

#include "core/limits.hpp"
#include "core/vec.hpp"

namespace twin::fuzz {

/// Highest feedrate, acceleration and jerk along a piece of path.
struct Pace {
  double feedrate = 0.0;      ///< V [mm/s]
  double acceleration = 0.0;  ///< A [mm/s^2]
  double jerk = 0.0;          ///< J [mm/s^3]
};

/// Shortest time from rest to rest over a length within V, A and J [s].
///
/// The motion is two equal ramps around a stretch of constant feedrate v. A ramp takes
///   v / A + A / J, or 2 sqrt(v / J) where v < A^2 / J,
/// and covers v / 2 times its time; v is V, or less where the length is too short for V.
double stop_time(double length, const Pace& pace);

/// A pace that keeps all limits everywhere on a piece of path of constant curvature or less.
///
/// With normal and tangential parts sharing the limits of single axes, the axes keep theirs if
///   a <= A / 2,  kappa v^2 <= A / 2,  j <= J / 3,  3 kappa v a <= J / 3,  kappa^2 v^3 <= J / 3.
/// It is no best pace: no planner should need longer than this with a stop at each end.
///
/// @param direction  largest share of each axis in the direction of motion, absolute values
/// @param radius     smallest radius of curvature; infinite on a line [mm]
/// @param feedrate   programmed [mm/s]
/// @param period     interpolation period [s]
/// @param chord      chord tolerance [mm]
/// @param model      whose servo errs by its tolerance on a circle at a feedrate that is not exceeded
Pace safe_pace(const Limits& limits, const Vec3& direction, double radius, double feedrate,
               double period, double chord, const PlanningModel& model);

}  // namespace twin::fuzz

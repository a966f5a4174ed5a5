#pragma once

namespace twin::feedrate {

/// Bounds of a change of feedrate.
struct RampLimits {
  double acceleration;  ///< A_max > 0 [mm/s^2]
  double jerk;          ///< J_max > 0 [mm/s^3]
};

/// Feedrate ramp: the fastest change from v1 to v2 with |a| <= A, |da/dt| <= J and a = 0 at both
/// ends.
///
/// With D = |v2 - v1| the ramp is symmetric about its middle. It takes
///   tau(D) = 2 sqrt(D / J)     where A is not reached, D <= A^2 / J
///   tau(D) = D / A + A / J     else
/// and, the mean feedrate of a symmetric ramp being (v1 + v2) / 2, it covers (v1 + v2) tau / 2.
/// [WY09, Eqs. 17-18 and 20-21] are the first case; the second adds the phase of constant
/// acceleration.
double ramp_time(double delta, const RampLimits& limits) noexcept;

/// Distance of the ramp from v1 to v2, either way [mm].
double ramp_distance(double v1, double v2, const RampLimits& limits) noexcept;

/// Largest feedrate v2 >= v1 whose ramp from v1 fits into a distance: ramp_distance(v1, v2) <=
/// distance [mm/s].
double ramp_reach(double v1, double distance, const RampLimits& limits) noexcept;

/// Distance covered by the ramp from v1 to v2 >= v1 until its feedrate is v, v1 <= v <= v2 [mm].
double ramp_distance_until(double v1, double v2, double v, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

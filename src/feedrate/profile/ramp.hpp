#pragma once

#include "feedrate/profile/ramp_limits.hpp"

namespace twin::feedrate {

/// Feedrate ramp: a change from v1 to v2 with |a| <= A, |da/dt| <= J and a = 0 at both ends, made
/// as limits.profile says: trapezoidal_ramp.hpp, s_curve_ramp.hpp, fir_ramp.hpp.
///
/// Every ramp is symmetric about its middle and depends on D = |v2 - v1| alone. It takes tau(D), 0
/// for D = 0, and, the mean feedrate of a symmetric ramp being (v1 + v2) / 2, it covers
/// (v1 + v2) tau / 2.
double ramp_time(double delta, const RampLimits& limits) noexcept;

/// tau(D) for D -> 0 [s]: the ramp of the least change. Not 0 with fir: there tau jumps at 0.
double least_ramp_time(const RampLimits& limits) noexcept;

/// Its phases; delta of any sign but not 0.
RampShape ramp_shape(double delta, const RampLimits& limits) noexcept;

/// Distance of the ramp from v1 to v2, either way [mm].
double ramp_distance(double v1, double v2, const RampLimits& limits) noexcept;

/// Largest feedrate v2 >= v1 whose ramp from v1 fits into a distance: ramp_distance(v1, v2) <=
/// distance [mm/s].
double ramp_reach(double v1, double distance, const RampLimits& limits) noexcept;

/// Distance covered by the ramp from v1 to v2 >= v1 until its feedrate is v, v1 <= v <= v2 [mm].
double ramp_distance_until(double v1, double v2, double v, const RampLimits& limits) noexcept;

/// Longest of all ramps from v down to feedrates w <= w_max [mm]: not the one to rest.
///
/// Where tau jumps, w -> v counts, which a w_max >= v includes.
double longest_descent(double v, double w_max, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

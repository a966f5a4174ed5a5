#pragma once

#include "core/limits.hpp"

namespace twin::feedrate {

/// Bounds of a change of feedrate, and how it is made within them.
struct RampLimits {
  double acceleration = 0.0;  ///< A_max > 0 [mm/s^2]
  double jerk = 0.0;          ///< J_max > 0 [mm/s^3]
  AccelerationProfile profile = AccelerationProfile::kTrapezoidal;
};

/// One ramp: its acceleration rises with constant jerk, stays, and falls as it rose.
///
///   a  |      ________
///      |     /        \.
///      |    /          \.
///      |___/____________\____ t
///          rise        rise
struct RampShape {
  double rise;                ///< time of each phase of jerk [s]
  double gain;                ///< change of feedrate in each of them [mm/s]
  double jerk = 0.0;          ///< in them [mm/s^3]
  double acceleration = 0.0;  ///< between them [mm/s^2]
};

/// Time tau(D) of a feedrate ramp: a change from v1 to v2 with |a| <= A, |da/dt| <= J and a = 0 at
/// both ends, made as limits.profile says (ramps.cpp has the three profiles) [s].
///
/// Every ramp is symmetric about its middle and depends on D = |v2 - v1| alone. A change of nothing
/// takes no time, tau(0) = 0. The mean feedrate of a symmetric ramp is (v1 + v2) / 2, so the ramp
/// covers (v1 + v2) tau / 2.
/// @param delta  v2 - v1, of any sign [mm/s]
double ramp_time(double delta, const RampLimits& limits) noexcept;

/// Time of the ramp of the least change, tau(D) for D -> 0 [s]. It is not 0 for the profile fir,
/// whose tau jumps at 0.
double least_ramp_time(const RampLimits& limits) noexcept;

/// Phases of a ramp.
/// @param delta  v2 - v1, of any sign but not 0 [mm/s]
RampShape ramp_shape(double delta, const RampLimits& limits) noexcept;

/// Distance of the ramp from v1 to v2, either way [mm].
double ramp_distance(double v1, double v2, const RampLimits& limits) noexcept;

/// Largest feedrate v2 >= v1 whose ramp from v1 fits into a distance: ramp_distance(v1, v2) <=
/// distance [mm/s].
double ramp_reach(double v1, double distance, const RampLimits& limits) noexcept;

/// Distance covered by the ramp from v1 to v2 >= v1 until its feedrate is v, v1 <= v <= v2 [mm].
double ramp_distance_until(double v1, double v2, double v, const RampLimits& limits) noexcept;

/// Length of the longest ramp from v down to any feedrate w in [0, w_max] [mm].
///
/// This is not the ramp to rest: braking further takes longer, but what it adds is covered at low
/// speed. For the profile fir, whose ramp time does not go to 0 with the change of feedrate, the
/// limit w -> v counts where w_max >= v.
double longest_descent(double v, double w_max, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

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

}  // namespace twin::feedrate

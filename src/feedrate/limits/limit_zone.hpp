#pragma once

#include <limits>

namespace twin::feedrate {

/// Stretch of the path with one feedrate limit; begin == end is a single place, such as a corner.
struct LimitZone {
  double begin = 0.0;                                             ///< distance along the path [mm]
  double end = 0.0;                                               ///< >= begin [mm]
  double limit = 0.0;                                             ///< [mm/s]
  double acceleration = std::numeric_limits<double>::infinity();  ///< tangential [mm/s^2]
  double jerk = std::numeric_limits<double>::infinity();          ///< tangential [mm/s^3]
};

}  // namespace twin::feedrate

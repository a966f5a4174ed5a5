#pragma once

#include <algorithm>
#include <cmath>

namespace twin::hal::mujoco {

/// Where a screw's two ends are against each other.
struct ScrewStretch {
  double length = 0.0;  ///< slide less motor, as travel [mm]
  double rate = 0.0;    ///< its change [mm/s]
};

/// Force with which a screw pulls its slide towards the motor, positive for a positive stretch [N].
///
/// With stiffness k, damping d and a play b between nut and screw, the flanks touch where
/// |length| > b / 2, and there
///   F = k (length - sgn(length) b / 2) + d rate,
/// but never so that one flank pulls at the other. Without play both flanks always touch.
/// Real-time safe.
///
/// @param stiffness  k [N/mm]  @param damping  d [N s/mm]  @param backlash  b >= 0 [mm]
inline double screw_force(const ScrewStretch& stretch, double stiffness, double damping,
                          double backlash) noexcept {
  if (!(backlash > 0.0)) {
    return stiffness * stretch.length + damping * stretch.rate;
  }
  const double depth = std::abs(stretch.length) - 0.5 * backlash;
  if (depth <= 0.0) {
    return 0.0;
  }
  const double side = std::copysign(1.0, stretch.length);
  return side * std::max(stiffness * depth + damping * side * stretch.rate, 0.0);
}

}  // namespace twin::hal::mujoco

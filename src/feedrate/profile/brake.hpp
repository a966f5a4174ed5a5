#pragma once

#include <array>

#include "feedrate/profile/phase.hpp"

namespace twin::feedrate {

/// The quickest way to rest from a feedrate v and an acceleration a: jerk down, hold the
/// deceleration, jerk back.
///
/// With a_p = min(A, sqrt(J v + a^2 / 2)) the phases are -J from a to -a_p, none at -a_p, +J from
/// -a_p to 0. No motion within A and J has less feedrate at any place, so braking keeps every limit
/// that the planned motion keeps.
/// @note Real-time safe.
struct Brake {
  std::array<Phase, 3> phases{};
  double distance = 0.0;  ///< from the start of braking to rest [mm]
  double duration = 0.0;  ///< [s]
};
Brake make_brake(const PathMotion& from, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

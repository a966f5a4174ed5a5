#pragma once

#include <vector>

#include "feedrate/paper/hump.hpp"

namespace twin::feedrate {

/// Stretch of time with constant jerk: s(t) = s + v t + a t^2/2 + j t^3/6 for 0 <= t <= duration.
struct Phase {
  double duration = 0.0;  ///< [s]
  double s = 0.0;         ///< distance at its start [mm]
  double v = 0.0;         ///< feedrate at its start [mm/s]
  double a = 0.0;         ///< tangential acceleration at its start [mm/s^2]
  double j = 0.0;         ///< tangential jerk [mm/s^3]
};

/// Motion along the path at one instant.
struct PathMotion {
  double s;  ///< [mm]
  double v;  ///< [mm/s]
  double a;  ///< [mm/s^2]
};

/// Motion at time t into a phase.
inline PathMotion motion_at(const Phase& phase, double t) noexcept {
  return {phase.s + t * (phase.v + t * (phase.a / 2.0 + t * phase.j / 6.0)),
          phase.v + t * (phase.a + t * phase.j / 2.0), phase.a + t * phase.j};
}

/// Time into a phase, in [0, duration], at which it reaches the distance s; feedrate must not be
/// negative in it.
double time_at(const Phase& phase, double s) noexcept;

/// The phase less its first part of time t.
Phase remainder_after(const Phase& phase, double t) noexcept;

/// Appends the up to seven phases of a hump.
void append_phases(const Hump& hump, const RampLimits& limits, std::vector<Phase>& phases);

}  // namespace twin::feedrate

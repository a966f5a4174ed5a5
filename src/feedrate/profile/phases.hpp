#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// A place of the path that is passed at a given feedrate with no tangential acceleration.
struct Anchor {
  double s = 0.0;            ///< distance along the path [mm]
  double v = 0.0;            ///< feedrate [mm/s]
  bool is_at_limit = false;  ///< v is the limit of the place itself, not reduced by its neighbours
};

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

/// Time since the begin of a phase, in [0, duration], at which it reaches the distance s [s]. The
/// feedrate must not be negative in the phase.
double time_at(const Phase& phase, double s) noexcept;

/// Time since the begin of a rising phase at which it has the feedrate v [s]; 0 where it is faster
/// from its start.
inline double rising_time(const Phase& phase, double v) noexcept {
  const double gain = v - phase.v;
  const double root = std::sqrt(std::max(phase.a * phase.a + 2.0 * phase.j * gain, 0.0));
  return gain > 0.0 ? 2.0 * gain / (phase.a + root) : 0.0;
}

/// What is left of a phase after the time t [s].
Phase remainder_after(const Phase& phase, double t) noexcept;

/// The quickest motion to rest from a feedrate v and an acceleration a, in three phases: build up
/// the deceleration, hold it, and reduce it to zero.
///
/// With a_p = min(A, sqrt(J v + a^2 / 2)) the phases are -J from a to -a_p, none at -a_p, +J from
/// -a_p to 0. No motion within A and J has less feedrate at any place, so braking keeps every limit
/// that the planned motion keeps.
struct Brake {
  std::array<Phase, 3> phases{};
  double distance = 0.0;  ///< from the start of braking to rest [mm]
  double duration = 0.0;  ///< [s]
};

/// Computes the brake that begins with a given motion.
/// @note Real-time safe.
Brake make_brake(const PathMotion& from, const RampLimits& limits) noexcept;

}  // namespace twin::feedrate

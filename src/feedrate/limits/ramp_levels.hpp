#pragma once

#include <cstdint>
#include <vector>

#include "feedrate/limits/zones.hpp"
#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// Direction along the path in which a feedrate rises.
enum class Sense : std::int8_t { kForward = 1, kBackward = -1 };

/// An acceleration that a zone allows up to a feedrate.
struct RampLevel {
  double top;           ///< up to this feedrate; infinite for the last level [mm/s]
  double acceleration;  ///< [mm/s^2]
};

/// Appends the levels of a zone, from rest on: a staircase under
///
///   a(v) = max(a_V, min(M (1 - S v^2), P (1 - R v^3) / v))      v <= V, and a_V above it
///
/// with V the zone's limit and a_V its acceleration there, M = `most`, S = `bend`, P = `power` and
/// R = `fade_up`; backward these are deceleration and `fade_down`. The less feedrate, the less of an
/// axis's acceleration and jerk goes into the bend, and the more acceleration is left. Neighbouring
/// levels differ by at most 1.25, so a motion has at least 0.8 a(v). A zone without `most` has one
/// level.
///
/// @param ramp  limits of the machine, which no level exceeds
void append_ramp_levels(const LimitZone& zone, Sense sense, const RampLimits& ramp,
                        std::vector<RampLevel>& levels);

}  // namespace twin::feedrate

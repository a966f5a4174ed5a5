#pragma once

#include "feedrate/profile/ramps.hpp"

namespace twin::feedrate {

/// What is known of the motion at one end of a leg, seen from that end into the leg: from its begin
/// forward in time, from its end backward.
struct LegEnd {
  double v = 0.0;      ///< the feedrate is at most this [mm/s]
  double a = 0.0;      ///< the feedrate rises into the leg by at most this acceleration [mm/s^2]
  double least = 0.0;  ///< and by at least this one, <= a [mm/s^2]
};

/// Shortest time in which a stretch of the path can be traversed within limits of feedrate,
/// acceleration and jerk that are constant on it.
///
/// In time t = 0..T all limits are linear in v: v <= F, |v'| <= A, |v''| <= J, and at the ends
/// v <= V, v' <= a. The longest way in a given time is therefore a linear problem, and its solution
/// is the well-known one: with jerk J, 0, -J up to a peak p, on at F if p is F, and down again in the
/// same way. An end whose acceleration would lead above p has the acceleration that leads to it,
/// sqrt(2 J (p - V)). An end that may be faster than p begins at p, or beyond it where its
/// acceleration may be negative. Where it has to be negative, a brake goes on, and the feedrate dips
/// by a^2 / (2 J) first. The way grows with p, and p follows from the way.
///
/// At an end |a| <= sqrt(2 J V): the feedrate is not negative beside it.
///
/// The result is a lower bound for every motion within these limits and is met by one of them, but
/// for ways too short for the accelerations at both ends, where only the time counts that the
/// acceleration takes from one to the other.
///
/// @param length  [mm]
/// @param cap     F, no less than the feedrates at the ends [mm/s]
/// @returns lower bound of the time [s]
double shortest_time(double length, double cap, const LegEnd& begin, const LegEnd& end,
                     const RampLimits& ramp) noexcept;

/// Way and time of one side of a leg, between its end and the peak.
struct LegSide {
  double distance;  ///< [mm]
  double time;      ///< [s]
};

/// The side of a leg up to a peak p, which is no less than v - a^2 / (2 J) where a < 0.
LegSide leg_side(const LegEnd& end, double peak, const RampLimits& ramp) noexcept;

}  // namespace twin::feedrate

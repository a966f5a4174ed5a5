#pragma once

namespace twin::feedrate {

/// Change D of feedrate that a ramp of two phases of jerk J makes within a distance.
///
/// With x = sqrt(D / J), half its time, the ramp from v covers (v + D / 2) 2 x: x is the root of
///   J x^3 + 2 v x = distance.
/// @param v         feedrate at the lower end [mm/s]
/// @param distance  >= 0 [mm]
/// @returns D = J x^2 [mm/s]
double jerk_ramp_change(double v, double distance, double jerk) noexcept;

}  // namespace twin::feedrate

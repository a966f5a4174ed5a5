#pragma once

namespace twin::feedrate {

/// Feedrate at which the chord between two set points just reaches the chord tolerance.
///
/// The set points of one period T are v T apart. On the osculating circle of radius rho = 1 / kappa
/// the chord is
///   delta = rho - sqrt(rho^2 - (v T / 2)^2)
/// away from the arc at its middle, so
///   v = (2 / T) sqrt(rho^2 - (rho - delta)^2) = (2 / T) sqrt(delta (2 rho - delta)).
/// This is the adaptive feedrate of confined chord error [WY09, refs. 4, 5]. No chord of the circle
/// is farther than rho from it: for rho <= delta there is no limit.
///
/// @param curvature    kappa >= 0 [1/mm]
/// @param chord_error  delta > 0 [mm]
/// @param period       interpolation period T > 0 [s]
/// @returns [mm/s]; infinity where the rule sets no limit
double chord_error_feedrate(double curvature, double chord_error, double period) noexcept;

}  // namespace twin::feedrate

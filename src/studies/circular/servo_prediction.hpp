#pragma once

#include <array>

#include "core/error.hpp"
#include "motion/motion_settings.hpp"

namespace twin::studies::circular {

/// Mean radial deviation that the servo's gains predict, -eps of
///   eps / r = 1 - sqrt((Kf^2 w^2 + Kp^2) / (w^2 + Kp^2)),   w = v / r    [WY09, Eq. 3]
/// as the mean over both axes.
///
/// Eq. 3 assumes a drive without lag; it leaves out sampling, friction, Kd and Ka.
///
/// @param gains     of x and y
/// @param radius    r [mm]
/// @param feedrate  v [mm/s]
/// @returns [mm], or an Error that says which gain Eq. 3 does not know
Expected<double> predicted_radial_deviation(const std::array<motion::Gains, 2>& gains,
                                            double radius, double feedrate);

}  // namespace twin::studies::circular

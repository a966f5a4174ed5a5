#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "motion/motion_settings.hpp"
#include "studies/circular/circle_fit.hpp"
#include "studies/circular/circle_program.hpp"

namespace twin::studies::circular {

/// Actual path of the measured turn in both senses, counter-clockwise first [mm].
using BothPaths = std::array<std::vector<Vec2>, 2>;

/// What ISO 230-4 says of one sense. Radial deviations are positive outside the nominal circle.
struct SenseDeviations {
  double circular = 0.0;    ///< circular deviation G: width of the minimum zone of the path [mm]
  double radial_max = 0.0;  ///< radial deviation F_max from the nominal circle [mm]
  double radial_min = 0.0;  ///< F_min [mm]
  Circle least_squares;     ///< of the path [mm]
};

/// What ISO 230-4 says of both senses together. H is of its first edition (1996); later editions
/// have G(b) and D in its place and write "error" for "deviation".
struct Deviations {
  std::array<SenseDeviations, 2> sense;  ///< counter-clockwise, clockwise
  double bidirectional = 0.0;            ///< G(b): width of the minimum zone of both paths [mm]
  double hysteresis = 0.0;   ///< H: largest difference of the two paths' radii at one angle, seen
                             ///< from the centre of their least-squares circle [mm]
  double mean_radial = 0.0;  ///< D: radius of the least-squares circle of both paths less the
                             ///< nominal radius [mm]
};

/// @param radius  of the nominal circle about (0, 0) [mm]
Deviations evaluate(const BothPaths& paths, double radius);

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

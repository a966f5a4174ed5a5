#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace twin::feedrate {

/// |a u + b q| <= c, a limit of one axis at one place, with q = v^2 [mm^2/s^2] and u the tangential
/// acceleration [mm/s^2].
struct Strip {
  double a;  ///< [-]
  double b;  ///< [1/mm]
  double c;  ///< [mm/s^2]
};

/// The limits of two places and three axes.
struct Strips {
  std::array<Strip, 6> strip{};
  std::size_t count = 0;

  void add(const Strip& s) noexcept { strip[count++] = s; }
};

/// A stretch of the path on which the limits count as constant.
struct Cell {
  double length = 0.0;        ///< [mm]
  double cap = 0.0;           ///< largest q on it [mm^2/s^2]
  double acceleration = 0.0;  ///< largest |u| [mm/s^2]
  Strips strips;              ///< for q at its begin and a constant u; none: cap and acceleration
};

inline constexpr double kNoCap = std::numeric_limits<double>::infinity();

}  // namespace twin::feedrate

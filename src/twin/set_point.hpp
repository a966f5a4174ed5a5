#pragma once

#include <array>
#include <cstdint>

namespace twin {

/// What a servo loop follows in one interpolation period: the place, and its derivatives in time.
struct SetPoint {
  double time = 0.0;                     ///< since the first set point [s]
  std::array<double, 3> position{};      ///< x, y, z [mm]
  std::array<double, 3> velocity{};      ///< x, y, z [mm/s]
  std::array<double, 3> acceleration{};  ///< x, y, z [mm/s^2]
  double feedrate = 0.0;                 ///< speed along the path [mm/s]
  std::int64_t segment = 0;              ///< number of the planned segment, from 0
  std::int64_t line = 0;                 ///< line of the NC program, from 1
};

}  // namespace twin

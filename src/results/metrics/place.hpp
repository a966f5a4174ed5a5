#pragma once

#include <cstdint>

#include "core/vec.hpp"

namespace twin::results {

/// Where and when something was in a run: the set point of that instant.
struct Place {
  double t = 0.0;                ///< time since the first set point [s]
  Vec3 position = Vec3::Zero();  ///< set point [mm]
  std::int64_t line = 0;         ///< NC line
  std::int64_t segment = 0;      ///< planned segment, counted from 0
};

}  // namespace twin::results

#pragma once

#include <cstdint>

#include "core/vec.hpp"

namespace twin::motion {

/// Reference of one interpolation period.
struct SetPoint {
  Vec3 position = Vec3::Zero();      ///< [mm]
  Vec3 velocity = Vec3::Zero();      ///< [mm/s]
  Vec3 acceleration = Vec3::Zero();  ///< [mm/s^2]
  double feedrate = 0.0;             ///< |velocity| [mm/s]
  double feedrate_limit = 0.0;       ///< limit of the place [mm/s]
  std::int64_t segment = 0;          ///< planned segment, counted from 0
  std::int64_t block = 0;            ///< NC block, counted from 0
  std::int64_t line = 0;             ///< NC line
};

}  // namespace twin::motion

#pragma once

#include <cmath>
#include <cstdint>

/// Between the wires (counts, volts) and the loop (mm, mm/s): the scaling of one axis.
namespace twin::motion {

inline constexpr double kMaxVolts = 10.0;  ///< largest drive command either way [V]

/// Position that encoder counts mean [mm]. @param mm_per_count encoder scale, signed [mm/count]
constexpr double position_from_counts(std::int64_t counts, double mm_per_count) noexcept {
  return static_cast<double>(counts) * mm_per_count;
}

/// Drive command for a velocity [V], not limited.
/// @param velocity           command velocity [mm/s]
/// @param mm_per_s_per_volt  V-REF scale of the drive, signed, not zero [mm/s/V]
constexpr double volts_from_velocity(double velocity, double mm_per_s_per_volt) noexcept {
  return velocity / mm_per_s_per_volt;
}

}  // namespace twin::motion

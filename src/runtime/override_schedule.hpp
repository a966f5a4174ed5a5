#pragma once

#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace twin::runtime {

inline constexpr double kHighestOverride = 200.0;  ///< [%]

/// A change of the feed override at a time of the motion.
struct OverrideChange {
  double time = 0.0;       ///< since the first set point [s]
  double percent = 100.0;  ///< of the programmed feedrate, 0 to 200; 0 holds [%]
};

/// Reads a schedule: "0:100,2:50,3.5:0" is seconds:percent, the seconds ascending.
Expected<std::vector<OverrideChange>> parse_override_schedule(std::string_view text);

}  // namespace twin::runtime

#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/vec.hpp"

namespace twin::studies::reproduce {

/// One set point of a trace.
struct Moment {
  double t = 0.0;             ///< [s]
  Vec2 point = Vec2::Zero();  ///< [mm]
  double feedrate = 0.0;      ///< [mm/s]
};

/// Feedrate-sensitive corners: the places where the feedrate falls and rises again by more than
/// `drop`, in the order of motion. Start and end of the motion are none.
///
/// @param drop  > 0 [mm/s]
std::vector<Moment> sensitive_corners(std::span<const Moment> motion, double drop);

/// "A", "B", ..., "Z", "A2", ...
std::string corner_letter(std::size_t index);

/// Part of the motion in which the feedrate changes most.
struct Window {
  double begin = 0.0;  ///< [s]
  double end = 0.0;    ///< [s]
};

/// The stretch of a given duration with the greatest total variation of the feedrate, the first
/// rise and the last fall left out.
Window most_violent(std::span<const Moment> motion, double duration);

}  // namespace twin::studies::reproduce

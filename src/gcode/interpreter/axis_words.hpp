#pragma once

#include <cmath>
#include <string_view>

#include "core/vec.hpp"
#include "gcode/words/line_words.hpp"

namespace twin::gcode {

inline constexpr std::string_view kAxes = "XYZ";

/// Whether a value is a whole number in a range.
inline bool is_whole_in(double value, double least, double most) {
  return value >= least && value <= most && value == std::floor(value);
}

/// Puts the numbers of a line's axis words into a vector.
inline void take_axes(const LineWords& words, double unit, Vec3& to) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char letter = kAxes[static_cast<std::size_t>(axis)];
    if (words.has(letter)) {
      to[axis] = words.value(letter) * unit;
    }
  }
}

}  // namespace twin::gcode

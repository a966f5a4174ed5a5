#pragma once

#include <cstdint>
#include <span>

#include "core/error.hpp"
#include "gcode/reader.hpp"
#include "studies/convert/converter.hpp"

namespace twin::studies::convert {

/// How far two programs are apart.
struct Deviation {
  double largest = 0.0;    ///< [mm]
  double tolerance = 0.0;  ///< of the path there [mm]
  std::int64_t line = 0;   ///< NC line of the first program there
};

/// Largest distance between a program and another that was made of it, group by group.
///
/// Both ways: places of each path, eight to a block and all the samples of a NURBS, against the
/// nearest place of the other path within the same group, near the same arc length.
///
/// @param before  reader at the beginning of the program
/// @param after   reader at the beginning of the new one
/// @returns the deviation that takes most of its tolerance; or the error of either program, or that
/// the new one has other blocks than it should
Expected<Deviation> compare_programs(gcode::Reader& before, gcode::Reader& after,
                                     std::span<const Group> groups);

}  // namespace twin::studies::convert

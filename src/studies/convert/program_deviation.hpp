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
/// The distance is taken both ways. Points of each path (eight to a block, and all the samples of a
/// NURBS) are held against the nearest point of the other path, within the same group and near the
/// same arc length.
///
/// @param before  reader at the beginning of the program
/// @param after   reader at the beginning of the new one
/// @returns the deviation that uses up most of its tolerance. An error is that of either program, or
/// says that the new program has other blocks than it should.
Expected<Deviation> compare_programs(gcode::Reader& before, gcode::Reader& after,
                                     std::span<const Group> groups);

}  // namespace twin::studies::convert

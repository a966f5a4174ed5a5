#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "core/path_settings.hpp"
#include "gcode/reader.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::studies::convert {

/// Blocks of the program and what has become of them.
struct Group {
  std::int64_t blocks = 0;  ///< of the program, one after the other
  std::int64_t made = 0;    ///< blocks of the new program that stand for them
  double tolerance = 0.0;   ///< path tolerance [mm]
  std::int64_t line = 0;    ///< NC line of the first
};

/// A program in another dialect.
struct Conversion {
  std::string text;
  std::vector<Group> groups;       ///< in order, all the blocks
  std::int64_t lines_before = 0;   ///< of text
  std::int64_t lines = 0;          ///< of text
  std::int64_t blocks = 0;         ///< of the program, those at rest included
  std::int64_t fitted_blocks = 0;  ///< of them, those that became curves
  std::int64_t curves = 0;         ///< fitted or given
  CurveCounts nurbs;               ///< what the curves became
};

/// Reads a program, fits its runs of short blocks, and writes it in a dialect. Nothing is planned.
///
/// Spindle, coolant, tool and comment words are not carried over: blocks do not hold them.
///
/// @param reader    at the beginning of the program
/// @param start     position before the program [mm]
/// @param name      of the program, for the comment on top
/// @returns the conversion; or the program's error, or why the dialect cannot have a curve of it
/// @note Holds the whole new program in memory.
Expected<Conversion> convert_program(gcode::Reader& reader, const Vec3& start,
                                     const std::string& name, const Dialect& dialect,
                                     const PathSettings& settings, const PlanningModel& planning,
                                     const Limits& limits);

}  // namespace twin::studies::convert

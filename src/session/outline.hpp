#pragma once

#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"

namespace twin::session {

/// Whether rapids are a part of an outline.
enum class Rapids { kDrawn, kLeftOut };

/// What pictures show of a program.
struct Outline {
  /// The programmed path seen along Z, arcs as chords of a degree, moves with the pen up left out (a
  /// point that is not a number lifts the line) [mm]; thinned on long programs.
  std::vector<Vec2> points;
  std::vector<std::int64_t> rapid_lines;  ///< lines of G00 in the order of the program
};

/// Reads the outline of a program up to its end or its first error.
/// @param reading  how the program is read; its feedrate does not matter
Outline programmed_outline(const gcode::ProgramText& program, Rapids rapids,
                           const gcode::ReaderOptions& reading);

}  // namespace twin::session

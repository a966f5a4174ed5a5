#pragma once

#include <cstdint>
#include <filesystem>

#include "core/error.hpp"
#include "core/limits.hpp"
#include "gcode/reader.hpp"

namespace twin::runtime {

/// What reading a whole program says before anything moves.
struct ProgramFigures {
  std::int64_t blocks = 0;      ///< blocks that move
  std::int64_t lines = 0;       ///< lines of text
  double length = 0.0;          ///< programmed length [mm]
  Vec3 box_min = Vec3::Zero();  ///< lower corner of the space it moves in, start included [mm]
  Vec3 box_max = Vec3::Zero();  ///< upper corner [mm]
};

/// Reads a program to its end and holds it against the machine's travel.
///
/// @returns the first error of the program, or the first block that leaves the travel (axis, place,
/// limit, line)
Expected<ProgramFigures> check_program(const std::filesystem::path& program,
                                       const gcode::ReaderOptions& options, const Limits& limits);

}  // namespace twin::runtime

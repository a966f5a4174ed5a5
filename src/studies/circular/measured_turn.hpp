#pragma once

#include <filesystem>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"

namespace twin::studies::circular {

/// The measured turn of one sense.
struct MeasuredTurn {
  std::vector<Vec2> table;    ///< true position, what a ballbar sees [mm]
  std::vector<Vec2> encoder;  ///< what the controller sees [mm]
  double feedrate = 0.0;      ///< mean of the set points' [mm/s]
};

/// Reads the rows of the measured turn from the trace of a program of circle_program().
///
/// @returns an Error if the trace has fewer than 60 of them
Expected<MeasuredTurn> read_measured_turn(const std::filesystem::path& trace);

}  // namespace twin::studies::circular

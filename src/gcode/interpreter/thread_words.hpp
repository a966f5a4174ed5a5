#pragma once

#include <optional>

#include "core/error.hpp"
#include "gcode/interpreter/threading_cycle.hpp"

namespace twin::gcode {

class LineWords;
struct ModalState;

/// Feedrate of a line with G33, G33.1 or G76: its lead times the speed of the spindle [mm/s].
///
/// @param own  takes the place of the program's feedrates, if any [mm/s]
/// @returns an error where the lead (K, of G76 P) or S is missing, or G96 is in force
Expected<double> thread_feedrate(const LineWords& words, const ModalState& state,
                                 const std::optional<double>& own);

/// How much faster G33.1 goes back: its I, or 1.
Expected<double> return_factor(const LineWords& words);

/// The words of a line with G76.
///
/// @param place     where the tool is, in the coordinates of the program [mm]
/// @param end       where X, Y and Z of the line lead [mm]
/// @param feedrate  of the thread [mm/s]
Expected<ThreadLine> read_thread_line(const LineWords& words, const ModalState& state,
                                      const Vec3& place, const Vec3& end, double feedrate);

}  // namespace twin::gcode

#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "gcode/reader_options.hpp"

namespace twin::gcode {

class LineWords;
class Notes;

/// Puts the words of a line whose meaning depends on the dialect into the common one, so that the
/// interpreter needs none, and notes what was meant.
///
///   G04 P   FANUC: milliseconds where P is written without a decimal point
///   G70 G71 inches and millimetres where no word of a lathe's cycle is beside them: Mach, ISO 6983
///   G04 X   FANUC: the same as G04 P with a decimal point, in seconds
/// A dwell of more than a minute is noted in any dialect. Source: FANUC, operator's manuals, "Dwell
/// (G04)".
///
/// @returns an error for a cycle of a lathe
Expected<void> to_common_meaning(LineWords& words, Dialect dialect, std::int64_t line,
                                 Notes& notes);

}  // namespace twin::gcode

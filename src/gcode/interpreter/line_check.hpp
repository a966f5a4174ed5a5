#pragma once

#include <cstdint>

#include "core/error.hpp"

namespace twin::gcode {

class LineWords;
class Notes;
struct ModalState;

/// Whether the words of a line belong together.
///
///   every letter needs a word on its line, or a motion word in force, that uses it; D, H and a zero
///     I, J or K that nothing uses are noted
///   X Y Z        need a motion word in force, or one word that uses them, and no G04 beside them
///   I J K R      of an arc: only those of the plane, and I J K not with R
///   G04          needs P
///   feed moves   need a feedrate, arcs I J K or R
///
/// @param state     modal state with the line's own words in force
/// @param has_own_feedrate  whether a feedrate takes the place of the F words
Expected<void> check_words(const LineWords& words, const ModalState& state, bool has_own_feedrate,
                           Notes& notes, std::int64_t line);

/// True if the line asks for a move by the motion in force: axis words that no other word uses, or
/// the centre of a full circle.
bool asks_for_move(const LineWords& words, const ModalState& state) noexcept;

/// True if the axis words of the line belong to a word that sets something or goes home, as G10,
/// G28, G92 or G43.1.
bool sets_by_axes(const LineWords& words) noexcept;

/// True if G05 or G05.1 of the line draws a curve, and is not FANUC's wish to look ahead.
bool draws_spline(const LineWords& words) noexcept;

}  // namespace twin::gcode

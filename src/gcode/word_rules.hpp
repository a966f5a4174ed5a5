#pragma once

#include "core/error.hpp"

namespace twin::gcode {

class LineWords;
struct ModalState;

/// Whether the words of a line belong together.
///
///   X Y Z    need a motion word in force, and no G04 beside them
///   I J K R  need G02 or G03; I J K only those of the plane, and not with R
///   P        needs G04 or G64, not both
///   G04      needs P
///   feed moves need a feedrate, arcs I J K or R
///
/// @param state  modal state with the line's own words in force
Expected<void> check_words(const LineWords& words, const ModalState& state);

/// True if the line asks for a move: axis words, or the centre of a full circle.
bool asks_for_move(const LineWords& words, const ModalState& state) noexcept;

}  // namespace twin::gcode

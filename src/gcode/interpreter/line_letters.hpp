#pragma once

#include <cstdint>

namespace twin::gcode {

class LineWords;
struct ModalState;

/// The letters that the G and M words of a line, and the motion in force, use besides X Y Z F S T
/// N: a set as of LineWords::letters().
///
/// @param state  modal state with the line's own words in force
std::uint32_t letters_taken(const LineWords& words, const ModalState& state) noexcept;

}  // namespace twin::gcode

#pragma once

#include "core/error.hpp"
#include "core/vec.hpp"

namespace twin::gcode {

class LineWords;
struct ModalState;

/// Gives a line with LinuxCNC's polar words the X and Y that they mean: @ is the distance from the
/// origin of the program's coordinates, ^ the angle from X in degrees. With G91 both count from the
/// place before. One that is left out keeps the value of that place. The polar words stay on the line,
/// for canned cycles that repeat by them. Source: LinuxCNC, "G-code overview", polar coordinates.
///
/// @param state  in force before the line
/// @param place  before the line, in the coordinates of the program [mm]
/// @returns an error outside G17, beside X, Y or a word that sets something, and with G91 at the
///          origin
Expected<void> polar_to_axes(LineWords& words, const ModalState& state, const Vec3& place);

}  // namespace twin::gcode

#pragma once

#include <span>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/block.hpp"

namespace twin::studies::predict {

/// The text of a program that moves as blocks do, each with a feedrate of its own: G90, G21, lines,
/// arcs and helices about Z, dwells, exact stops and path tolerances.
///
/// @param feedrates  of each block [mm/s]; of rapids and dwells it does not matter
/// @param title      a line of comment, without parentheses
/// @returns a kProgram error for what it cannot write: NURBS, and arcs about another axis than Z
Expected<std::string> feed_program(std::span<const gcode::Block> blocks,
                                   std::span<const double> feedrates,
                                   const config::MachineFile& machine, const std::string& title);

}  // namespace twin::studies::predict

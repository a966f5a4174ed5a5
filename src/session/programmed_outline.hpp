#pragma once

#include <filesystem>
#include <vector>

#include "core/vec.hpp"

namespace twin::session {

/// Programmed path seen along Z, arcs as chords of a degree, moves with the pen up
/// left out (a point that is not a number lifts the line) [mm]; thinned on long programs.
std::vector<Vec2> programmed_outline(const std::filesystem::path& program);

}  // namespace twin::session

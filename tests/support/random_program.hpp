#pragma once

#include <random>
#include <vector>

#include "gcode/block.hpp"

namespace twin::test {

/// A program of lines, arcs, helices, smooth runs of short blocks, crumbs, zigzags, dwells, exact
/// stops, rapids and changes of feedrate, as nasty as the seed has it.
std::vector<gcode::Block> random_program(std::mt19937& random, int pieces);

}  // namespace twin::test

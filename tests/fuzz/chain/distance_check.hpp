#pragma once

#include "tests/fuzz/chain/limit_check.hpp"

namespace twin::fuzz {

/// Measures how far the set points are from the programmed path, and whether they pass the end of
/// each block, in their order.
///
/// The path is the polylines of the made program, with the tolerance of a block and of its
/// neighbours.
void measure_distance(const Case& made, const Trajectory& trajectory, Shares& shares);

}  // namespace twin::fuzz

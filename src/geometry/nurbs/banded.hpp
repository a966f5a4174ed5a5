#pragma once

#include <array>
#include <span>

#include "core/vec.hpp"

namespace twin::geometry {

/// Row r of a matrix with two diagonals on either side of the main one: elements (r, r-2) .. (r,
/// r+2). Elements that would lie outside the matrix are ignored.
using BandRow = std::array<double, 5>;

/// Solves A x = b for three right-hand sides at once, by elimination without exchange of rows.
///
/// Collocation matrices of B-splines are totally positive; for those the growth of rounding errors
/// without pivoting is no worse than with it, and the band does not widen: O(n).
///
/// @param rows  A (n x n), destroyed
/// @param x     in: b, out: x; one row of three columns each (n x 3)
/// @note Real-time safe.
void solve_pentadiagonal(std::span<BandRow> rows, std::span<Vec3> x) noexcept;

}  // namespace twin::geometry

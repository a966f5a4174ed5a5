#pragma once

#include "feedrate/bound/cell.hpp"

namespace twin::feedrate {

/// Largest q at the begin of a cell from which q <= `end` at its end can be reached: the backward
/// step of reachability analysis.
///
/// With u constant on the cell of length l, q grows by 2 u l. Every limit bounds u from below or
/// above by a line over q,
///   max_i (l_i + m_i q) <= u <= min_j (h_j + n_j q),
/// and a u exists where each lower line is below each upper one; each pair bounds q. The limits
/// hold at q = u = 0, so every smaller q is controllable as well.
double largest_begin(const Cell& cell, double end) noexcept;

/// Largest q at the end of a cell, at most `end`, that is reached from q = `begin`: the forward
/// step. `begin` is no more than largest_begin(cell, end).
double largest_end(const Cell& cell, double begin, double end) noexcept;

/// Whether q is linear over a cell: where it has strips, but between two rests. Else q rises at the
/// acceleration limit up to the cap, at most, and falls again.
bool is_linear(const Cell& cell, double begin, double end) noexcept;

/// Shortest time on a cell between two q [s]; where q is linear, t = 2 l / (v_0 + v_1).
double cell_time(const Cell& cell, double begin, double end) noexcept;

/// Largest q inside a cell.
double cell_peak(const Cell& cell, double begin, double end) noexcept;

}  // namespace twin::feedrate

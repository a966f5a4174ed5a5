#pragma once

#include "feedrate/bound/cell.hpp"

namespace twin::feedrate {

/// Largest q = v^2 at the begin of a cell from which some q <= `end` can be reached at its end: the
/// backward step of reachability analysis.
///
/// With a constant tangential acceleration u on the cell of length l, q grows by 2 u l. Every limit
/// bounds u from below or above by a line over q,
///   max_i (l_i + m_i q) <= u <= min_j (h_j + n_j q).
/// A u exists where each lower line is below each upper one, so each pair of lines bounds q. The
/// limits hold at q = u = 0, and therefore at every smaller q as well.
double largest_begin(const Cell& cell, double end) noexcept;

/// Largest q at the end of a cell, at most `end`, that is reached from q = `begin`: the forward
/// step. `begin` is no more than largest_begin(cell, end).
double largest_end(const Cell& cell, double begin, double end) noexcept;

/// Whether q is linear over a cell. It is where the cell has strips, unless the motion rests at
/// both ends. Where it is not, q rises at the acceleration limit, at most up to the cap, and falls
/// again.
bool is_linear(const Cell& cell, double begin, double end) noexcept;

/// Shortest time on a cell between two q [s]; where q is linear, t = 2 l / (v_0 + v_1).
double cell_time(const Cell& cell, double begin, double end) noexcept;

/// Largest q inside a cell.
double cell_peak(const Cell& cell, double begin, double end) noexcept;

}  // namespace twin::feedrate

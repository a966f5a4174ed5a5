#pragma once

#include <span>
#include <vector>

#include "core/limits.hpp"
#include "feedrate/bound/cell.hpp"
#include "feedrate/limits/feedrate_rules.hpp"
#include "feedrate/limits/zones.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// How fine a grid is.
struct Fineness {
  double limit = 0.02;  ///< largest difference of the feedrate limits on one cell [-]
  double turn = 0.05;   ///< largest turn of a cell, where axes have limits of their own [rad]

  Fineness halved() const noexcept { return {0.5 * limit, 0.5 * turn}; }
};

/// Appends the cells of one segment.
///
/// A line is one cell, and so is an arc unless an axis has a limit of its own. A curve is divided
/// at its curvature samples, and further by halves where the limit changes within a cell.
///
/// The cap of a cell is the largest limit on it. It comes from the least curvature, with d2C/ds2
/// taken as linear over the cell. So the staircase of caps is nowhere below the limit, and a coarse
/// grid gives a bound that is too low, not too high. Successive cells without axis limits and with
/// the same cap become one.
///
/// @param zones  the planner's limits of the segment: the cap is nowhere below them
void append_cells(const path::Segment& segment, std::span<const LimitZone> zones,
                  const feedrate::FeedrateRules& rules, const Limits& limits,
                  const Fineness& fineness, std::vector<Cell>& cells);

}  // namespace twin::feedrate

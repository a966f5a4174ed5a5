#pragma once

#include <vector>

#include "compare/comparison.hpp"
#include "report/album.hpp"

namespace twin::compare {

/// Adds the figure `planners` to an album: the feedrate of the planners over the path, under that
/// of their lower bounds, as a whole and where most time is lost, and the time that every
/// contestant has lost to its bound up to each place.
Expected<void> add_planner_figure(report::Album& album, const Comparison& comparison);

}  // namespace twin::compare

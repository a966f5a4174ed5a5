#pragma once

#include <vector>

#include "pictures/figure/album.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Adds the figure `planners` to an album. It shows the feedrate of each planner along the path
/// below that of its lower bound, for the whole path and where most time is lost, and the time that
/// every contestant has lost to its bound up to each point of the path.
Expected<void> add_planner_figure(pictures::Album& album, const Comparison& comparison);

}  // namespace twin::studies::compare

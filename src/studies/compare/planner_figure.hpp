#pragma once

#include <vector>

#include "pictures/figure/album.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Adds the figure `planners` to an album: the feedrate of the planners over the path, under that
/// of their lower bounds, as a whole and where most time is lost, and the time that every
/// contestant has lost to its bound up to each place.
Expected<void> add_planner_figure(pictures::Album& album, const Comparison& comparison);

}  // namespace twin::studies::compare

#pragma once

#include <filesystem>
#include <vector>

#include "pictures/figure/album.hpp"
#include "studies/compare/comparison.hpp"

namespace twin::studies::compare {

/// Draws the comparison as PNG and SVG with data and gnuplot scripts.
///
///   compare      feedrate and contour error of the interpolators over time, their machining times
///                and contour errors as bars
///   planners     feedrate of the planners over the path under that of their lower bound, see
///                add_planner_figure()
///   fluctuation  feedrate fluctuation of the parameter updates over time; of programs with curves
///
/// @param folder  is made
Expected<std::vector<pictures::Picture>> draw_figures(const Comparison& comparison,
                                                      const std::filesystem::path& folder);

/// Adds the figure `planners` to an album. It shows the feedrate of each planner along the path
/// below that of its lower bound, for the whole path and where most time is lost, and the time that
/// every contestant has lost to its bound up to each point of the path.
Expected<void> add_planner_figure(pictures::Album& album, const Comparison& comparison);

}  // namespace twin::studies::compare

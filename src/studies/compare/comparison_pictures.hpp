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

}  // namespace twin::studies::compare

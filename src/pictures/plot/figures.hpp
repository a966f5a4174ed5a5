#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "pictures/figure/paper.hpp"

namespace twin::pictures {

/// What the figures of one run are made from.
struct FigureInput {
  std::filesystem::path directory;  ///< holds the trace; the figures go to its folder plots
  std::string title;                ///< above every figure, as in "dolphin.nc, 3000 mm/min"
  /// The programmed path as a polyline: arcs are sampled, and NaN lifts the line [mm]. May be empty.
  std::vector<Vec2> programmed = {};
  bool plan_only = false;  ///< the trace has no machine in it, so only the command is drawn
  std::string trace = "trace.csv";  ///< name of the trace
  Paper paper = Paper::kNone;
};

/// Draws the figures of a run as PNG and SVG, in the manner of Figs. 12 to 19 of the paper.
///
///   contour              programmed, command and measured path
///   contour_magnified    the same, with the error square to the path magnified
///   feedrate             feedrate over time, and its limit where there is plots/feedrate_limit.csv
///   acceleration_jerk    tangential acceleration and jerk of the set points
///   contour_error        contour error over time
///   tracking_errors      tracking error of each axis over time
///   timing               how late periods began and how long they took; only for a run on the wall
///                        clock, which leaves plots/timing.csv
///
/// Titles say "simulated" where summary.json beside the trace does, and the line below them has the
/// settings of the run that summary.json has. A PDF for a paper has neither.
///
/// Beside each NAME.png and NAME.svg stand its data NAME.csv and its script NAME.gp; "gnuplot
/// NAME.gp" draws it again. Long traces are thinned so that no peak is lost. With plan_only the
/// figures that need a machine are left out.
///
/// @returns the pictures that were written
Expected<std::vector<std::filesystem::path>> write_figures(const FigureInput& input);

}  // namespace twin::pictures

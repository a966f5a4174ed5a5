#pragma once

#include <string>
#include <vector>

#include "pictures/plot/figure_data.hpp"

namespace twin::pictures {

/// A gnuplot script under its figure's name.
struct Script {
  std::string name;  ///< of the figure, as in "contour"
  std::string text;
};

/// What stands above a figure; any text.
struct Heading {
  std::string title;     ///< as in "dolphin.nc, simulated"
  std::string settings;  ///< of the run, in one line; may be empty
};

/// Any text as a gnuplot string expression.
std::string quoted(const std::string& text);

/// Magnification 1, 2 or 5 times a power of ten at which the largest error spans about a twentieth
/// of the picture.
///
/// @param extent            longer side of the path's bounding box [mm]
/// @param largest_error_um  [um]
/// @returns at least 1
double magnification(double extent, double largest_error_um);

/// The scripts of all figures of a run or of a plan.
std::vector<Script> figure_scripts(const Heading& heading, const DataSummary& data, bool plan_only);

/// The figure of a run on the wall clock, from timing.csv: how many periods over how late they
/// began, how long their computation took, and when their outputs were written.
///
/// @param period  marked by a line [s]; 0: none
Script timing_script(const Heading& heading, double period);

}  // namespace twin::pictures

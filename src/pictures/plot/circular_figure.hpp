#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "pictures/figure/paper.hpp"

namespace twin::pictures {

/// What the polar figure of a circular test is made from.
struct CircularFigureInput {
  std::filesystem::path directory;            ///< the figure goes to its folder plots
  std::string title;                          ///< first line above the figure
  std::string subtitle;                       ///< second line
  double radius = 0.0;                        ///< of the nominal circle about (0, 0) [mm]
  std::array<std::span<const Vec2>, 2> path;  ///< counter-clockwise, clockwise; one turn each [mm]
  Paper paper = Paper::kNone;
};

/// Radial error that one division of the figure stands for: 1, 2 or 5 times a power of ten, so that
/// the largest error spans up to four divisions.
///
/// @param largest_error  [mm]
/// @returns [mm]; a nanometre at least
double radial_division(double largest_error);

/// Draws the figure: both paths about the nominal circle, their radial errors magnified.
///
/// Writes plots/circular_test.png, .svg, for a paper .pdf, their data .csv and script .gp.
/// @returns the pictures
Expected<std::vector<std::filesystem::path>> write_circular_figure(
    const CircularFigureInput& input);

}  // namespace twin::pictures

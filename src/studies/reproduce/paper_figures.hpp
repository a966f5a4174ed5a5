#pragma once

#include <filesystem>
#include <vector>

#include "core/error.hpp"
#include "pictures/figure/album.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// Draws Figs. 12 to 19 in the paper's arrangement, from the traces of the single runs as
/// published, as PNG and SVG with their data and gnuplot scripts.
///
///   12, 13  a contour with feedrate-sensitive corners, b feedrate, c the portion of it that
///           changes most; NURBS at 3,000 mm/min
///   14, 15  feedrate at 3,000, 2,000 and 1,000 mm/min
///   16, 17  a contour errors, b tracking errors; NURBS at 3,000 mm/min
///   18, 19  a feedrate commands, b contour errors; Fast Bezier at 3,000 mm/min
///
/// The first of each pair is of the oxalis, the second of the dolphin.
///
/// @param folder  is made
Expected<std::vector<pictures::Picture>> draw_figures(const Reproduction& reproduction,
                                                      const std::filesystem::path& folder);

}  // namespace twin::studies::reproduce

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "pictures/figure/album.hpp"
#include "pictures/figure/figure_script.hpp"
#include "results/trace/decimator.hpp"
#include "studies/reproduce/reproduction.hpp"

namespace twin::studies::reproduce {

/// The panels of Figs. 12 and 13: contour, feedrate, and the part of the feedrate that changes
/// most, with the feedrate-sensitive corners marked by letters in the order of motion.
///
/// @param table     columns t_s, x_cmd_mm, y_cmd_mm, feedrate_mm_per_s
/// @param data      name of the data file of that table, without extension
/// @param feedrate  programmed [mm/s]
std::vector<pictures::Panel> contour_panels(const results::Table& table, const std::string& data,
                                            double feedrate);

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

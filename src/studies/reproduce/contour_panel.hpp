#pragma once

#include <string>
#include <vector>

#include "pictures/figure/figure_script.hpp"
#include "results/trace/decimator.hpp"

namespace twin::studies::reproduce {

/// The panels of Figs. 12 and 13: contour, feedrate, and the part of the feedrate that changes
/// most, with the feedrate-sensitive corners marked by letters in the order of motion.
///
/// @param table     columns t_s, x_cmd_mm, y_cmd_mm, feedrate_mm_per_s
/// @param data      name of the data file of that table, without extension
/// @param feedrate  programmed [mm/s]
std::vector<pictures::Panel> contour_panels(const results::Table& table, const std::string& data,
                                            double feedrate);

}  // namespace twin::studies::reproduce

#pragma once

#include <filesystem>
#include <span>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "results/trace/program_zero.hpp"

namespace twin::pictures {

/// What the scripts must know of the data before they can be written.
struct DataSummary {
  Vec2 extent = Vec2::Zero();       ///< width and height of the path [mm]
  double largest_error_um = 0.0;    ///< largest error square to the path, pen down [um]
  Vec2 worst_at = Vec2::Zero();     ///< measured place of the largest contour error, pen down [mm]
  double worst_um = 0.0;            ///< that error, 0: none [um]
  double acceleration_limit = 0.0;  ///< 0: not known [mm/s^2]
  double jerk_limit = 0.0;          ///< 0: not known [mm/s^3]
  bool has_limit = false;           ///< feedrate_limit.csv is there
  bool has_pen_up = false;          ///< the pen is lifted at some set points
  bool has_programmed = false;      ///< contour_programmed.csv was written
};

/// Reads a trace once and writes the data of all figures, thinned, into the folder of the plots.
///
/// @param trace       trace.csv
/// @param folder      existing folder for the data
/// @param programmed  programmed path [mm], may be empty
/// @param zero        height of the program's Z0
/// @param plan_only   the trace has the columns of a plan alone
Expected<DataSummary> write_figure_data(const std::filesystem::path& trace,
                                        const std::filesystem::path& folder,
                                        std::span<const Vec2> programmed,
                                        const results::ProgramZero& zero, bool plan_only);

}  // namespace twin::pictures

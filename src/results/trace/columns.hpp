#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "results/trace/sample.hpp"
#include "twin/trace.hpp"

/// Names of the columns of a trace, in their order; units are part of the names and both are an
/// interface.
namespace twin::results {

inline constexpr std::size_t kPlanColumns = 7;  ///< columns of a trace without a machine

inline constexpr std::array<std::string_view, 16> kColumns{
    "t_s",                  // time since the first set point
    "segment",              // planned segment, counted from 0
    "line",                 // NC line
    "x_cmd_mm",             // set point
    "y_cmd_mm",             //
    "z_cmd_mm",             //
    "feedrate_mm_per_s",    // of the set point, along the path
    "x_enc_mm",             // what the encoder counts mean
    "y_enc_mm",             //
    "x_table_mm",           // true position of the table
    "y_table_mm",           //
    "x_drive_V",            // drive command
    "y_drive_V",            //
    "contour_error_um",     // distance of the encoder's position from the programmed path
    "x_tracking_error_um",  // set point less encoder
    "y_tracking_error_um"};

inline constexpr std::string_view kTraceName = "trace.csv";
inline constexpr std::string_view kPartialTraceName = "trace.partial.csv";
/// In the folder of the plots: histograms of the periods of a run on the wall clock.
inline constexpr std::string_view kTimingName = "timing.csv";
/// In the folder of the plots: the feedrate limit over time.
inline constexpr std::string_view kLimitName = "feedrate_limit.csv";

/// Height of the pen above which it does not draw [mm]. A program that never comes below is drawn
/// all the same.
inline constexpr double kPenUp = 0.1;

/// Which columns a trace has.
enum class Layout {
  kPlan,  ///< set points alone: the first kPlanColumns columns
  kRun,   ///< all columns
};

/// The columns of a layout. @param period interpolation period [s]
TraceHeader trace_header(Layout layout, double period);

/// Appends a sample to rows of a trace. Tracking errors are command less encoder.
///
/// @param contour_error  distance of the encoder's position from the programmed path [mm], used by
///                       Layout::kRun
void append_row(const Sample& sample, double contour_error, Layout layout,
                std::vector<double>& rows);

}  // namespace twin::results

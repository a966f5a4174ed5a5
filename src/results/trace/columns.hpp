#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "results/trace/sample.hpp"
#include "twin/trace.hpp"

/// Names of the columns of a trace, in their order; units are part of the names and both are an
/// interface.
namespace twin::results {

inline constexpr std::size_t kPlanColumns = 7;  ///< columns of a trace without a machine

/// Columns that a trace has unless others are chosen.
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

/// Columns that --columns adds.
inline constexpr std::array<std::string_view, 12> kMoreColumns{
    "path_mm",                          // way of the set points since the first one
    "feedrate_limit_mm_per_s",          // limit in force at the set point; 0: none
    "pen",                              // 1 with the pen down, 0 with it up
    "rapid",                            // 1 on a rapid (G00), else 0
    "command_contour_error_signed_um",  // positive left of the motion of the set point
    "contour_error_signed_um",          // the same of the encoder's position
    "table_contour_error_signed_um",    // the same of the table's true position
    "interpolated",                     // 1: the period never began, measured values are made up
    "x_torque_Nm",                      // of the motor; of a simulated table
    "y_torque_Nm",                      //
    "x_friction_N",                     // of the slide, positive against positive motion
    "y_friction_N"};

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
  kRun,   ///< all of kColumns
};

/// Numbers of columns: places in kColumns, and behind those in kMoreColumns.
using ColumnChoice = std::vector<std::size_t>;

/// The columns of a layout.
ColumnChoice columns_of(Layout layout);

/// The columns that a text names, "t_s,x_cmd_mm,x_torque_Nm". The name "default" stands for the
/// columns of the layout, "all" for all that the run can have.
///
/// @param has_forces  whether the machine tells torques and friction
/// @returns the columns in the order of the text, or a kUsage error that names the unknown one
Expected<ColumnChoice> choose_columns(std::string_view text, Layout layout, bool has_forces);

/// The header of a trace. @param period  interpolation period [s]
TraceHeader trace_header(const ColumnChoice& columns, double period);
TraceHeader trace_header(Layout layout, double period);

/// What is known of a sample besides what the cycle recorded. Signed errors are positive left of
/// the motion of the set point.
struct Deviations {
  double contour_error = 0.0;         ///< distance of the encoder's position from the path [mm]
  double signed_contour_error = 0.0;  ///< the same with its sign [mm]
  double signed_table_error = 0.0;    ///< of the table's true position [mm]
  double signed_command_error = 0.0;  ///< of the set point [mm]
  double path_length = 0.0;           ///< way of the set points since the first one [mm]
  bool is_rapid = false;              ///< the set point is on a rapid
};

/// Appends a sample to rows of a trace. Tracking errors are command less encoder.
void append_row(const Sample& sample, const Deviations& deviations, const ColumnChoice& columns,
                std::vector<double>& rows);
/// @param contour_error  distance of the encoder's position from the programmed path [mm], used by
///                       Layout::kRun
void append_row(const Sample& sample, double contour_error, Layout layout,
                std::vector<double>& rows);

}  // namespace twin::results

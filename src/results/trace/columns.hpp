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

/// What is known of a column of traces.
struct Column {
  std::string_view name;       ///< with its unit
  std::string_view unit;       ///< as UCUM writes it, as in "mm/s"; "1" for a plain number
  std::string_view long_name;  ///< what it is, in words
  bool is_whole = false;       ///< whole numbers, such as line numbers
};

/// Columns that a trace has unless others are chosen.
inline constexpr std::array<Column, 16> kColumns{{
    {"t_s", "s", "time since the first set point"},
    {"segment", "1", "planned segment, counted from 0", true},
    {"line", "1", "line of the NC program", true},
    {"x_cmd_mm", "mm", "set point of x"},
    {"y_cmd_mm", "mm", "set point of y"},
    {"z_cmd_mm", "mm", "set point of z"},
    {"feedrate_mm_per_s", "mm/s", "feedrate of the set point along the path"},
    {"x_enc_mm", "mm", "position of x by its encoder"},
    {"y_enc_mm", "mm", "position of y by its encoder"},
    {"x_table_mm", "mm", "true position of the table along x"},
    {"y_table_mm", "mm", "true position of the table along y"},
    {"x_drive_V", "V", "drive command of x"},
    {"y_drive_V", "V", "drive command of y"},
    {"contour_error_um", "um", "distance of the encoders' position from the programmed path"},
    {"x_tracking_error_um", "um", "set point less encoder, x"},
    {"y_tracking_error_um", "um", "set point less encoder, y"},
}};

/// Columns that --columns adds.
inline constexpr std::array<Column, 12> kMoreColumns{{
    {"path_mm", "mm", "way of the set points since the first one"},
    {"feedrate_limit_mm_per_s", "mm/s", "feedrate limit in force at the set point; 0 for none"},
    {"pen", "1", "1 with the pen down, 0 with it up", true},
    {"rapid", "1", "1 on a rapid (G00), else 0", true},
    {"command_contour_error_signed_um", "um",
     "contour error of the set point, positive left of its motion"},
    {"contour_error_signed_um", "um",
     "contour error of the encoders' position, positive left of the set point's motion"},
    {"table_contour_error_signed_um", "um",
     "contour error of the table's true position, positive left of the set point's motion"},
    {"interpolated", "1", "1 where the period never began and measured values are made up", true},
    {"x_torque_Nm", "N.m", "torque of the motor of x"},
    {"y_torque_Nm", "N.m", "torque of the motor of y"},
    {"x_friction_N", "N", "friction of the slide of x, positive against positive motion"},
    {"y_friction_N", "N", "friction of the slide of y, positive against positive motion"},
}};

/// In the folder of the plots: histograms of the periods of a run on the wall clock.
inline constexpr std::string_view kTimingName = "timing.csv";
/// In the folder of the plots: the feedrate limit over time.
inline constexpr std::string_view kLimitName = "feedrate_limit.csv";

/// Height of the pen above the program's Z0 from which on it does not draw [mm]. A program that never comes below is drawn
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
  double pen_up = kPenUp;             ///< height on the machine above which the pen is up [mm]
};

/// Appends a sample to rows of a trace. Tracking errors are command less encoder.
void append_row(const Sample& sample, const Deviations& deviations, const ColumnChoice& columns,
                std::vector<double>& rows);
/// @param contour_error  distance of the encoder's position from the programmed path [mm], used by
///                       Layout::kRun
void append_row(const Sample& sample, double contour_error, Layout layout,
                std::vector<double>& rows);

}  // namespace twin::results

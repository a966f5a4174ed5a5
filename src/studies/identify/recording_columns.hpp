#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace twin::studies::identify {

/// What a trace may tell, by the name that --columns gives it.
enum Signal : std::size_t {
  kTime,
  kXCommand,
  kXMeasured,
  kXVolts,
  kXForce,
  kXTorque,
  kXTable,
  kYCommand,
  kYMeasured,
  kYVolts,
  kYForce,
  kYTorque,
  kYTable
};
inline constexpr std::size_t kSignals = 13;
inline constexpr std::size_t kSignalsOfAxis = 6;
inline constexpr std::array<std::string_view, kSignals> kSignalNames{
    "t",     "x_cmd",  "x_meas", "x_V",     "x_force",  "x_torque", "x_table",
    "y_cmd", "y_meas", "y_V",    "y_force", "y_torque", "y_table"};

/// What the unit of a column measures.
enum class Quantity {
  kTime,           ///< base unit s
  kLength,         ///< mm
  kVoltage,        ///< V
  kSpeed,          ///< mm/s; of a drive command that is a speed
  kRotationSpeed,  ///< rpm; the same
  kForce,          ///< N
  kTorque,         ///< N m
};

/// One column of a file: its name there, and its unit.
struct Column {
  std::string name;          ///< in the file's header
  double to_base = 1.0;      ///< base value (s, mm, V, N, N m) = value in the file x to_base
  bool is_required = false;  ///< named by the user: must be there
  Quantity quantity = Quantity::kLength;
};

/// Which column holds which signal.
using ColumnMap = std::array<Column, kSignals>;

/// The columns of a trace.csv.
ColumnMap trace_columns();

/// Reads "t=time_ms:ms,x_cmd=ref_x,x_meas=pos_x:um": SIGNAL=COLUMN or SIGNAL=COLUMN:UNIT.
///
/// Units are s, ms, us, and for a counter its period, as in t=cycle:2ms; m, mm, um; V, mV, and for
/// drive commands mm/s, m/s, rpm, too; N, kN; N_m, mN_m. Signals that are not named keep the column
/// of a trace.csv, which has no force, torque and scale on the table.
/// @returns kUsage error for an unknown signal, an empty column, or a unit of something else
Expected<ColumnMap> parse_columns(std::string_view text);

}  // namespace twin::studies::identify

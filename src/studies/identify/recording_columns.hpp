#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace twin::studies::identify {

/// What a trace may tell, by the name that --columns gives it.
enum Signal : std::size_t { kTime, kXCommand, kXMeasured, kXVolts, kYCommand, kYMeasured, kYVolts };
inline constexpr std::size_t kSignals = 7;
inline constexpr std::array<std::string_view, kSignals> kSignalNames{
    "t", "x_cmd", "x_meas", "x_V", "y_cmd", "y_meas", "y_V"};

/// One column of a file: its name there, and its unit.
struct Column {
  std::string name;          ///< in the file's header
  double to_base = 1.0;      ///< base value (s, mm, V) = value in the file x to_base
  bool is_required = false;  ///< named by the user: must be there
};

/// Which column holds which signal.
using ColumnMap = std::array<Column, kSignals>;

/// The columns of a trace.csv.
ColumnMap trace_columns();

/// Reads "t=time_ms:ms,x_cmd=ref_x,x_meas=pos_x:um": SIGNAL=COLUMN or SIGNAL=COLUMN:UNIT, the unit
/// one of s, ms, us, m, mm, um, V, mV. Signals that are not named keep the column of a trace.csv.
/// @returns kUsage error for an unknown signal, an empty column, or a unit of something else
Expected<ColumnMap> parse_columns(std::string_view text);

}  // namespace twin::studies::identify

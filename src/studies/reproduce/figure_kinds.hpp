#pragma once

#include <span>
#include <string_view>

#include "config/machine_file.hpp"
#include "results/metrics/summary.hpp"

namespace twin::studies::reproduce {

/// One column of a published table: where its numbers stand, how they are written, and which of our
/// figures answers it.
struct FigureKind {
  std::string_view key;   ///< in a row of the data file, as in "contour_um.max"
  std::string_view name;  ///< of the column, as in "contour error max"
  std::string_view unit;  ///< "um"; empty where there is none
  int decimals = 0;       ///< as printed
  double (*ours)(const results::Summary& summary,
                 const config::MachineFile& machine);  ///< in the column's unit
};

inline constexpr int kFirstTable = 1;
inline constexpr int kLastTable = 5;

/// Columns of a table, in the order in which they are printed; empty for a table there is not.
std::span<const FigureKind> columns_of(int table);

/// Tables 4 and 5 hold what was measured on the rig; their figures are those that are counted.
constexpr bool is_measured(int table) { return table >= 4; }

}  // namespace twin::studies::reproduce

#pragma once

#include <span>
#include <string_view>

#include "config/machine_file.hpp"
#include "results/metrics/summary.hpp"

namespace twin::studies::reproduce {

/// One column of a published table: where its numbers stand, how they are written, and which of our
/// numbers answers it.
struct PublishedColumn {
  std::string_view key;       ///< in a row of the data file, as in "contour_um.max"
  std::string_view name;      ///< of the column, as in "contour max"
  std::string_view unit;      ///< "um"; empty where there is none
  int decimals = 0;           ///< as printed
  std::string_view quantity;  ///< key of the results::Quantity that answers it; empty: none does
  double (*answer)(const results::Summary& summary,
                   const config::MachineFile& machine) = nullptr;  ///< in place of a quantity

  /// Our number, in the column's unit; 0 where the run has none.
  double ours(const results::Summary& summary, const config::MachineFile& machine) const;
};

inline constexpr int kFirstTable = 1;
inline constexpr int kLastTable = 5;

/// Columns of a table, in the order in which they are printed; empty for a table that does not
/// exist.
std::span<const PublishedColumn> columns_of(int table);

/// Tables 4 and 5 hold what was measured on the rig; only their numbers are counted.
constexpr bool is_measured(int table) { return table >= 4; }

}  // namespace twin::studies::reproduce

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace twin::pictures {

/// A column of a page.
struct PageColumn {
  std::string name;            ///< with its unit
  double step = 1.0;           ///< to which it is rounded, in that unit
  std::vector<double> values;  ///< a number for each row
};

/// The rows of a trace as a page shows them.
struct PageRows {
  std::size_t rows_of_trace = 0;
  bool is_thinned = false;  ///< rows are left out; the extremes of each column are there
  double last_time = 0.0;   ///< of the trace [s]
  std::vector<PageColumn> columns;

  std::size_t rows() const noexcept { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// Rows above which a trace is thinned.
inline constexpr std::size_t kMostPageRows = 1000000;

/// Reads what a page shows of a trace: the columns that are there, the size of the acceleration, the
/// signed contour error, and the feedrate limit of the file beside the trace.
///
/// The contour error is positive left of the motion of the set point. Where the trace has it
/// without a sign, its sign is that of the side of the encoder's position, as seen from the set
/// point nearest to it.
///
/// @param trace   trace.csv, or one of a run that ended early
/// @param limits  plots/feedrate_limit.csv; need not be there
/// @param most    rows above which rows are left out
Expected<PageRows> read_page_rows(const std::filesystem::path& trace,
                                  const std::filesystem::path& limits,
                                  std::size_t most = kMostPageRows);

}  // namespace twin::pictures

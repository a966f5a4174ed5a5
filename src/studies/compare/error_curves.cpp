#include "studies/compare/error_curves.hpp"

#include <algorithm>
#include <array>

#include "results/metrics/feedrate_fluctuation.hpp"
#include "results/trace/trace_reader.hpp"

namespace twin::studies::compare {
namespace {

void add_row(results::Table& table, double t, double value) {
  table.values.push_back(t);
  table.values.push_back(value);
}

}  // namespace

results::Table running_maximum(const results::Table& table, std::size_t pieces) {
  results::Table result{2, {}};
  if (table.rows() == 0) {
    return result;
  }
  const double begin = table.at(0, 0);
  const double stretch = (table.at(table.rows() - 1, 0) - begin) / static_cast<double>(pieces);
  std::size_t row = 0;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const double end = begin + stretch * static_cast<double>(piece + 1);
    const bool is_last = piece + 1 == pieces;
    double largest = 0.0;
    const std::size_t first = row;
    for (; row < table.rows() && (is_last || table.at(row, 0) < end); ++row) {
      largest = row == first ? table.at(row, 1) : std::max(largest, table.at(row, 1));
    }
    if (row > first) {
      add_row(result, end - 0.5 * stretch, largest);
    }
  }
  return result;
}

Expected<results::Table> read_contour_error(const std::filesystem::path& trace) {
  constexpr std::array<std::string_view, 2> kColumns{"t_s", "contour_error_um"};
  results::Table table{2, {}};
  const auto take = [&table](std::span<const double> row) { add_row(table, row[0], row[1]); };
  TWIN_CHECK(results::read_rows(trace, kColumns, take));
  return table;
}

Expected<results::Table> read_fluctuation(const std::filesystem::path& trace, double period) {
  constexpr std::array<std::string_view, 5> kColumns{"t_s", "x_cmd_mm", "y_cmd_mm", "z_cmd_mm",
                                                     "feedrate_mm_per_s"};
  results::Table table{2, {}};
  results::FeedrateFluctuation fluctuation(period);
  const auto take = [&](std::span<const double> row) {
    const auto share = fluctuation.add({row[1], row[2], row[3]}, row[4]);
    if (share) {
      const double late = (results::FeedrateFluctuation::kDelay - 0.5) * period;
      add_row(table, row[0] - late, 100.0 * *share);
    }
  };
  TWIN_CHECK(results::read_rows(trace, kColumns, take));
  return table;
}

}  // namespace twin::studies::compare

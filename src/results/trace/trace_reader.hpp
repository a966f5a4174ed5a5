#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "results/trace/csv_reader.hpp"
#include "results/trace/hdf5.hpp"

namespace twin::results {

/// Reads the rows of a trace by column name, in memory that does not depend on its length. The file
/// is CSV or HDF5, by its content and not by its name.
///
/// A column of an HDF5 file is a dataset. All that are chosen must have the same number of rows; of a
/// file that a killed run has left, the rows are those that every chosen column has.
class TraceReader {
 public:
  /// Opens the file and reads the names of its columns.
  static Expected<TraceReader> open(const std::filesystem::path& file);

  /// Names of the columns; of an HDF5 file in alphabetical order.
  const std::vector<std::string>& header() const noexcept;
  bool has(std::string_view column) const noexcept;

  /// Chooses the columns that next() delivers, in this order; all of the header by default.
  Expected<void> select(std::span<const std::string_view> columns);

  /// Reads one row.
  ///
  /// @param values  receives the chosen columns, as many as were chosen
  /// @returns false when there is no further row; an error for a value that is no finite number
  Expected<bool> next(std::span<double> values);

  /// Calls `take(std::span<const double>)` with every further row.
  template <class Take>
  Expected<void> for_each_row(Take&& take) {
    std::vector<double> row(chosen());
    for (;;) {
      TWIN_TRY(const bool has_row, next(row));
      if (!has_row) {
        return {};
      }
      take(std::span<const double>(row));
    }
  }

  /// An error about the row that next() has delivered last: with its line in a CSV file, with its
  /// number from 1 in an HDF5 file.
  tl::unexpected<Error> wrong_row(std::string message) const;

 private:
  /// An HDF5 file and the rows that are read ahead of it.
  struct Hdf5Rows {
    std::string name;
    std::unique_ptr<Hdf5Columns> columns;
    std::vector<std::size_t> chosen{};         // columns of next(), in its order
    std::size_t rows = 0;                      // of the chosen columns
    std::size_t next = 0;                      // row that comes next
    std::size_t begin = 0;                     // first row of `ahead`
    std::vector<std::vector<double>> ahead{};  // (chosen columns x rows read ahead)

    Expected<void> select(std::span<const std::string_view> names);
    Expected<void> count_rows();
    Expected<void> read_ahead();
    Expected<bool> take(std::span<double> values);
    tl::unexpected<Error> complaint(std::string message) const;
  };

  TraceReader() = default;
  std::size_t chosen() const noexcept;

  std::optional<CsvReader> csv_;
  std::optional<Hdf5Rows> hdf5_;  // one of the two
};

/// Calls `take(std::span<const double>)` with the chosen columns of every row of a trace.
template <class Take>
Expected<void> read_rows(const std::filesystem::path& file,
                         std::span<const std::string_view> columns, Take&& take) {
  TWIN_TRY(TraceReader reader, TraceReader::open(file));
  TWIN_CHECK(reader.select(columns));
  return reader.for_each_row(std::forward<Take>(take));
}

}  // namespace twin::results

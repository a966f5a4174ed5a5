#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace twin::results {

/// Reads numbers from a CSV file by column name, row by row, in memory that does not depend on its
/// length.
///
/// The first line is the header. Column order and further columns do not matter; spaces around a
/// field, CRLF, a byte order mark and blank lines at the end are accepted. A wanted field that is
/// missing or no finite number is an error with line and column.
class CsvReader {
 public:
  /// Opens the file and reads its header.
  static Expected<CsvReader> open(const std::filesystem::path& file);

  const std::vector<std::string>& header() const noexcept { return header_; }
  bool has(std::string_view column) const noexcept;

  /// Chooses the columns that next() delivers, in this order; all of the header by default.
  Expected<void> select(std::span<const std::string_view> columns);

  /// Reads one row.
  ///
  /// @param values  receives the chosen columns, as many as were chosen
  /// @returns false when there is no further row
  Expected<bool> next(std::span<double> values);

  /// Calls `take(std::span<const double>)` with every further row.
  template <class Take>
  Expected<void> for_each_row(Take&& take) {
    std::vector<double> row(chosen_);
    for (;;) {
      TWIN_TRY(const bool has_row, next(row));
      if (!has_row) {
        return {};
      }
      take(std::span<const double>(row));
    }
  }

  int line() const noexcept { return line_; }                 ///< line of the last row, from 1
  const std::string& name() const noexcept { return name_; }  ///< of the file
  std::size_t chosen() const noexcept { return chosen_; }     ///< number of chosen columns

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };

  CsvReader() = default;
  Expected<bool> read_line(std::string_view& line);
  Expected<void> parse(std::string_view line, std::span<double> values) const;
  tl::unexpected<Error> complaint(std::string message, std::size_t column = 0) const;

  std::string name_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> block_;  // what was read; the next line starts at begin_
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  int line_ = 0;
  std::vector<std::string> header_;
  std::vector<int> slot_;  // per field of the file: its place in next()'s values, or -1
  std::size_t chosen_ = 0;
  std::size_t last_field_ = 0;  // fields beyond this one are not looked at
};

}  // namespace twin::results

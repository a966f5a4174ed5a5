#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "twin/error.hpp"
#include "twin/export.hpp"

namespace twin {

/// A column of a trace. A trace is a table with one row for each interpolation period;
/// docs/manual.md lists its columns.
struct TraceColumn {
  /// Kind of the numbers in the column.
  enum class Kind {
    kReal,   ///< real numbers, measured or computed
    kWhole,  ///< whole numbers up to 2^53, such as counts and line numbers
  };
  std::string name;  ///< name with its unit, as in "x_cmd_mm"
  Kind kind = Kind::kReal;
  std::string unit{};       ///< as UCUM writes it, as in "mm/s"; "1" for a plain number
  std::string long_name{};  ///< what it is, as in "set point of x"
};

/// Description of a trace, given before its first row.
struct TraceHeader {
  std::vector<TraceColumn> columns;  ///< in the order of the values in a row
  double period = 0.001;             ///< interpolation period, the time from row to row [s]
};

/// Receives the rows of a run while the machine moves. Implement this to store or show them.
///
///   begin --> rows --> rows --> ... --> commit    the run reached the end of the program
///                                  \--> abandon   it failed or was interrupted
///
/// All calls come from the thread that called run(), and never from the real-time cycle, so they
/// may allocate and write files. If a call returns an error or throws, the machine brakes on the
/// path and the run ends. A sink whose begin() has returned nothing is always told the end of the
/// run by commit() or abandon(), also after an error of its own.
class TWIN_EXPORT TraceSink {
 public:
  TraceSink() = default;
  TraceSink(const TraceSink&) = delete;
  TraceSink& operator=(const TraceSink&) = delete;
  virtual ~TraceSink() = default;

  /// Called once, before anything moves. @returns nothing, or why the sink cannot take the trace
  virtual std::optional<Error> begin(const TraceHeader& header) = 0;
  /// Takes the next rows, at least one.
  /// @param values  (rows x columns), row after row
  /// @returns nothing, or why the rows cannot be taken
  virtual std::optional<Error> rows(std::span<const double> values) = 0;
  /// Called at the end of a run that reached the end of the program: the trace is complete.
  /// @returns nothing, or why the trace cannot be finished
  virtual std::optional<Error> commit() = 0;
  /// Called at the end of any other run: the rows so far are only a part of the trace.
  virtual void abandon() noexcept = 0;
};

/// Keeps a trace in memory. Its columns are found by name:
///
///     for (const double x : trace["x_cmd_mm"]) { ... }
class TWIN_EXPORT MemoryTrace final : public TraceSink {
 public:
  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override {}

  const TraceHeader& header() const noexcept { return header_; }
  /// Number of rows received so far.
  std::size_t size() const noexcept { return columns_.empty() ? 0 : columns_.front().size(); }
  /// Whether the trace has a column of this name.
  bool has(std::string_view column) const noexcept;
  /// The values of a column, one for each row. They are valid until the next row comes.
  /// @throws std::out_of_range if the trace has no such column
  std::span<const double> operator[](std::string_view column) const;
  /// Whether the run reached the end of the program.
  bool is_complete() const noexcept { return is_complete_; }

 private:
  std::size_t index_of(std::string_view column) const noexcept;

  TraceHeader header_;
  std::vector<std::vector<double>> columns_;
  bool is_complete_ = false;
};

/// Writes a trace to the file FOLDER/trace.csv, byte for byte as `twin run` does.
///
/// While the run is under way the file is called trace.partial.csv. It keeps this name if the run
/// fails.
class TWIN_EXPORT CsvTrace final : public TraceSink {
 public:
  /// @param folder  folder of the file; begin() makes it if it is missing
  explicit CsvTrace(const std::string& folder);
  ~CsvTrace() override;

  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Reads a trace from a file, CSV or HDF5 by its content. All columns are real numbers without units,
/// and the period is the difference of the first two times of the column "t_s", if there are any.
/// @throws Failure that names file, line or row
TWIN_EXPORT void read_trace(const std::string& file, TraceSink& sink);

}  // namespace twin

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

/// A column of a trace.
struct TraceColumn {
  /// What its numbers are.
  enum class Kind {
    kReal,   ///< measured or computed
    kWhole,  ///< counted: a whole number, up to 2^53
  };
  std::string name;  ///< with its unit, as in "x_cmd_mm"
  Kind kind = Kind::kReal;
};

/// What is known of a trace before its first row.
struct TraceHeader {
  std::vector<TraceColumn> columns;
  double period = 0.001;  ///< from one row to the next [s]
};

/// Takes the rows of a run: one row an interpolation period, while the machine moves.
///
///   begin --> rows --> rows --> ... --> commit    the run reached the end of the program
///                                  \--> abandon   it failed or was interrupted
///
/// All calls come from one thread, the one that called the run, and never from the real-time cycle.
/// An error that a call returns, or an exception that it throws, brakes the machine on the path and
/// ends the run; after begin() a run always ends with commit() or abandon(), also when the sink has
/// failed.
class TWIN_EXPORT TraceSink {
 public:
  TraceSink() = default;
  TraceSink(const TraceSink&) = delete;
  TraceSink& operator=(const TraceSink&) = delete;
  virtual ~TraceSink() = default;

  /// A run begins. It calls this before anything moves.
  virtual std::optional<Error> begin(const TraceHeader& header) = 0;
  /// Takes the next rows, one after the other in their order. @param values (rows x columns)
  virtual std::optional<Error> rows(std::span<const double> values) = 0;
  /// The trace is whole.
  virtual std::optional<Error> commit() = 0;
  /// No more rows follow, and what there is is only a part of the trace.
  virtual void abandon() noexcept = 0;
};

/// A trace in memory, its columns by name.
class TWIN_EXPORT MemoryTrace final : public TraceSink {
 public:
  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override {}

  const TraceHeader& header() const noexcept { return header_; }
  /// Number of rows so far.
  std::size_t size() const noexcept { return columns_.empty() ? 0 : columns_.front().size(); }
  bool has(std::string_view column) const noexcept;
  /// All numbers of a column, such as "x_cmd_mm".
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

/// A trace as the file FOLDER/trace.csv, byte for byte that of `twin run`.
///
/// While the run goes on the rows are in FOLDER/trace.partial.csv; there they stay when it fails.
class TWIN_EXPORT CsvTrace final : public TraceSink {
 public:
  /// @param folder  made when the run begins, if it is missing
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

}  // namespace twin

#pragma once

#include <filesystem>

#include "results/trace/csv_file.hpp"
#include "results/trace/sample.hpp"

namespace twin::results {

/// Which columns a trace has.
enum class Layout {
  kPlan,  ///< set points alone: the first kPlanColumns columns
  kRun,   ///< all columns
};

/// Streams samples into DIR/trace.csv, one row an interpolation period.
///
/// Until commit() the rows are in DIR/trace.partial.csv; there they stay when the run fails, is
/// interrupted, or the process is killed. A commit replaces an older trace in one step.
class CsvWriter {
 public:
  /// @param directory  existing folder of the results
  static Expected<CsvWriter> create(const std::filesystem::path& directory, Layout layout);

  /// Appends one row. Tracking errors are command less encoder.
  ///
  /// @param contour_error  distance of the encoder's position from the programmed path [mm], used
  /// by Layout::kRun
  Expected<void> write(const Sample& sample, double contour_error = 0.0);

  /// Gives the whole trace its name.
  Expected<void> commit() { return file_.commit(); }
  /// Leaves what was recorded as trace.partial.csv; the destructor does the same.
  void abandon() noexcept { file_.abandon(); }

 private:
  CsvWriter(CsvFile&& file, Layout layout) : file_(std::move(file)), layout_(layout) {}

  CsvFile file_;
  Layout layout_;
  Row row_;
};

}  // namespace twin::results

#pragma once

#include <filesystem>

#include "results/trace/csv_file.hpp"

namespace twin::results {

/// Streams the feedrate limit over time into feedrate_limit.csv (t_s,feedrate_limit_mm_per_s) for
/// the feedrate figure.
///
/// Only the rows where the limit changes are kept, each with the row before it, so that straight
/// lines between rows give the limit back exactly.
class LimitWriter {
 public:
  /// @param directory  existing folder of the plots
  static Expected<LimitWriter> create(const std::filesystem::path& directory);

  /// @param t      time since the first set point [s], ascending
  /// @param limit  limit in force [mm/s]; not finite: none, the row is left out
  Expected<void> write(double t, double limit);
  Expected<void> commit();
  void abandon() noexcept { file_.abandon(); }

 private:
  explicit LimitWriter(CsvFile&& file) : file_(std::move(file)) {}
  Expected<void> flush();

  CsvFile file_;
  double last_t_ = 0.0;
  double last_limit_ = -1.0;  // none yet
  bool is_pending_ = false;   // the last row is not written yet
};

}  // namespace twin::results

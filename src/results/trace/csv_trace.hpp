#pragma once

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "results/trace/csv_file.hpp"
#include "twin/trace.hpp"

namespace twin::results {

/// Streams a trace into DIR/trace.csv, one line a row.
///
/// Until commit() the rows are in DIR/trace.partial.csv; there they stay when the run fails, is
/// interrupted, or the process is killed. A commit replaces an older trace in one step.
class CsvTrace final : public TraceSink {
 public:
  /// @param directory  folder of the results, which exists when the run begins
  explicit CsvTrace(std::filesystem::path directory, Durability durability = Durability::kSynced)
      : directory_(std::move(directory)), durability_(durability) {}

  std::optional<Error> begin(const TraceHeader& header) override;
  std::optional<Error> rows(std::span<const double> values) override;
  std::optional<Error> commit() override;
  void abandon() noexcept override;

 private:
  std::filesystem::path directory_;
  Durability durability_;
  std::optional<CsvFile> file_;
  std::vector<TraceColumn::Kind> kinds_;
  Row row_;
};

}  // namespace twin::results

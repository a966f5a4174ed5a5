#include "results/trace/csv_trace.hpp"

#include <string_view>

#include "results/trace/trace_files.hpp"

namespace twin::results {

std::optional<Error> CsvTrace::begin(const TraceHeader& header) {
  std::vector<std::string_view> names;
  kinds_.clear();
  for (const TraceColumn& column : header.columns) {
    names.push_back(column.name);
    kinds_.push_back(column.kind);
  }
  auto file = CsvFile::create(directory_ / kTraceName, directory_ / kPartialTraceName, names,
                              OnAbandon::kKeep, durability_);
  if (!file) {
    return std::move(file).error();
  }
  file_.emplace(std::move(*file));
  return std::nullopt;
}

std::optional<Error> CsvTrace::rows(std::span<const double> values) {
  for (std::size_t begin = 0; begin < values.size(); begin += kinds_.size()) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      const double value = values[begin + i];
      if (kinds_[i] == TraceColumn::Kind::kWhole) {
        row_.add(static_cast<std::int64_t>(value));
      } else {
        row_.add(value);
      }
    }
    if (auto written = file_->write(row_); !written) {
      return std::move(written).error();
    }
  }
  return std::nullopt;
}

std::optional<Error> CsvTrace::commit() {
  auto done = file_->commit();
  return done ? std::nullopt : std::optional(std::move(done).error());
}

void CsvTrace::abandon() noexcept {
  if (file_) {
    file_->abandon();
  }
}

}  // namespace twin::results

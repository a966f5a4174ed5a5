#include "results/trace/trace_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace twin::results {
namespace {

/// What the writer of traces fills in where a chunk was never written: no number, or the lowest
/// whole one.
bool is_unwritten(double value) { return std::isnan(value) || value < -9e18; }

}  // namespace

Expected<TraceReader> TraceReader::open(const std::filesystem::path& file) {
  TraceReader reader;
  if (!is_hdf5(file)) {
    TWIN_TRY(reader.csv_, CsvReader::open(file));
    return reader;
  }
  TWIN_TRY(const Hdf5Module* const module, hdf5_module());
  TWIN_TRY(auto columns, module->open(file));
  reader.hdf5_.emplace(Hdf5Rows{.name = file.string(), .columns = std::move(columns)});
  if (reader.hdf5_->columns->names().empty()) {
    return reader.hdf5_->complaint("has no column: no dataset of numbers at its root");
  }
  return reader;
}

const std::vector<std::string>& TraceReader::header() const noexcept {
  return csv_ ? csv_->header() : hdf5_->columns->names();
}

bool TraceReader::has(std::string_view column) const noexcept {
  return std::ranges::find(header(), column) != header().end();
}

std::size_t TraceReader::chosen() const noexcept {
  if (csv_) {
    return csv_->chosen();
  }
  return hdf5_->chosen.empty() ? header().size() : hdf5_->chosen.size();
}

Expected<void> TraceReader::select(std::span<const std::string_view> columns) {
  return csv_ ? csv_->select(columns) : hdf5_->select(columns);
}

Expected<bool> TraceReader::next(std::span<double> values) {
  if (csv_) {
    return csv_->next(values);
  }
  if (hdf5_->chosen.empty()) {
    const std::vector<std::string_view> all(header().begin(), header().end());
    TWIN_CHECK(hdf5_->select(all));
  }
  return hdf5_->take(values);
}

tl::unexpected<Error> TraceReader::wrong_row(std::string message) const {
  return csv_ ? tl::unexpected(
                    Error{ErrorCode::kFile, std::move(message), csv_->name(), csv_->line(), 1})
              : hdf5_->complaint(fmt::format("row {}: {}", hdf5_->next, message));
}

tl::unexpected<Error> TraceReader::Hdf5Rows::complaint(std::string message) const {
  return tl::unexpected(Error{ErrorCode::kFile, std::move(message), name, 0, 0});
}

Expected<void> TraceReader::Hdf5Rows::select(std::span<const std::string_view> names) {
  chosen.clear();
  const std::vector<std::string>& known = columns->names();
  for (const std::string_view column : names) {
    const auto found = std::ranges::find(known, column);
    if (found == known.end()) {
      std::string list;
      for (const std::string& has : known) {
        list.append(list.empty() ? "" : ",").append(has);
      }
      return complaint(fmt::format("no column {}; there are: {}", column, list.substr(0, 400)));
    }
    chosen.push_back(static_cast<std::size_t>(found - known.begin()));
  }
  ahead.assign(chosen.size(), {});
  return count_rows();
}

/// The rows that the chosen columns have. A killed run may have written some columns further than
/// others, and leaves rows that were never filled.
Expected<void> TraceReader::Hdf5Rows::count_rows() {
  rows = columns->rows(chosen.front());
  for (const std::size_t column : chosen) {
    const std::size_t others = columns->rows(column);
    if (others != rows && !columns->is_unfinished()) {
      return complaint(fmt::format("column {} has {} rows, but {} has {}", columns->names()[column],
                                   others, columns->names()[chosen.front()], rows));
    }
    rows = std::min(rows, others);
  }
  while (columns->is_unfinished() && rows > 0) {
    bool is_written = true;
    for (const std::size_t column : chosen) {
      double last = 0.0;
      // Where a kill fell into the flush, a chunk may be told of and lie behind the file's end.
      const bool is_read = columns->read(column, rows - 1, std::span(&last, 1)).has_value();
      is_written = is_written && is_read && !is_unwritten(last);
    }
    if (is_written) {
      break;
    }
    rows -= std::min(rows, kHdf5ChunkRows);
  }
  return {};
}

Expected<void> TraceReader::Hdf5Rows::read_ahead() {
  begin = next;
  const std::size_t count = std::min(rows - next, kHdf5ChunkRows);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    ahead[i].resize(count);
    TWIN_CHECK(columns->read(chosen[i], begin, ahead[i]));
  }
  return {};
}

Expected<bool> TraceReader::Hdf5Rows::take(std::span<double> values) {
  if (next == rows) {
    return false;
  }
  if (next >= begin + ahead.front().size()) {
    TWIN_CHECK(read_ahead());
  }
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    values[i] = ahead[i][next - begin];
    if (!std::isfinite(values[i])) {
      return complaint(fmt::format("row {}: {} in column {} is not a finite number", next + 1,
                                   values[i], columns->names()[chosen[i]]));
    }
  }
  ++next;
  return true;
}

}  // namespace twin::results

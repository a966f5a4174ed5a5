#include <algorithm>
#include <stdexcept>

#include "twin/trace.hpp"

namespace twin {

std::optional<Error> MemoryTrace::begin(const TraceHeader& header) {
  header_ = header;
  columns_.assign(header.columns.size(), {});
  is_complete_ = false;
  return std::nullopt;
}

std::optional<Error> MemoryTrace::rows(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    columns_[i % columns_.size()].push_back(values[i]);
  }
  return std::nullopt;
}

std::optional<Error> MemoryTrace::commit() {
  is_complete_ = true;
  return std::nullopt;
}

std::size_t MemoryTrace::index_of(std::string_view column) const noexcept {
  const auto found = std::ranges::find(header_.columns, column, &TraceColumn::name);
  return static_cast<std::size_t>(found - header_.columns.begin());
}

bool MemoryTrace::has(std::string_view column) const noexcept {
  return index_of(column) < columns_.size();
}

std::span<const double> MemoryTrace::operator[](std::string_view column) const {
  if (!has(column)) {
    throw std::out_of_range("the trace has no column " + std::string(column));
  }
  return columns_[index_of(column)];
}

}  // namespace twin

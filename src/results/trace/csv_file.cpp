#include "results/trace/csv_file.hpp"

#include <cassert>
#include <charconv>
#include <string>
#include <utility>

namespace twin::results {

Row& Row::add(double value) noexcept {
  assert(size_ + kWidest < text_.size());
  const double clean = value + 0.0;  // -0 + 0 = 0
  char* const end = std::to_chars(&text_[size_], text_.data() + text_.size(), clean).ptr;
  *end = ',';
  size_ = static_cast<std::size_t>(end - text_.data()) + 1;
  return *this;
}

Row& Row::add(std::int64_t value) noexcept {
  assert(size_ + kWidest < text_.size());
  char* const end = std::to_chars(&text_[size_], text_.data() + text_.size(), value).ptr;
  *end = ',';
  size_ = static_cast<std::size_t>(end - text_.data()) + 1;
  return *this;
}

std::string_view Row::finish() noexcept {
  const std::size_t size = std::exchange(size_, 0);
  if (size == 0) {
    text_[0] = '\n';
    return {text_.data(), 1};
  }
  text_[size - 1] = '\n';
  return {text_.data(), size};
}

Expected<CsvFile> CsvFile::create(std::filesystem::path target, std::filesystem::path temporary,
                                  std::span<const std::string_view> columns, OnAbandon on_abandon,
                                  Durability durability) {
  std::string header;
  for (const std::string_view column : columns) {
    header.append(column).push_back(',');
  }
  header.back() = '\n';
  TWIN_TRY(AtomicFile file,
           AtomicFile::create(std::move(target), std::move(temporary), on_abandon, durability));
  TWIN_CHECK(file.write(header));
  return CsvFile(std::move(file));
}

Expected<void> CsvFile::write(std::span<const double> values) {
  Row row;
  for (const double value : values) {
    row.add(value);
  }
  return write(row);
}

}  // namespace twin::results

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "core/atomic_file.hpp"

namespace twin::results {

/// One row of numbers as text: comma, no spaces, the shortest digits that read back as the same
/// double.
class Row {
 public:
  static constexpr std::size_t kMostFields = 32;

  Row& add(double value) noexcept;  ///< -0 is written as 0
  Row& add(std::int64_t value) noexcept;

  /// The row with its line end; valid until the next add(). The next add() starts a new row.
  std::string_view finish() noexcept;

 private:
  static constexpr std::size_t kWidest = 25;  // "-2.2250738585072014e-308,"

  std::array<char, kMostFields * kWidest + 1> text_{};
  std::size_t size_ = 0;
};

/// A table of numbers on disk, written whole or not at all (see AtomicFile).
class CsvFile {
 public:
  /// Opens the temporary file and writes the header line.
  static Expected<CsvFile> create(std::filesystem::path target, std::filesystem::path temporary,
                                  std::span<const std::string_view> columns,
                                  OnAbandon on_abandon = OnAbandon::kRemove,
                                  Durability durability = Durability::kSynced);

  Expected<void> write(Row& row) { return file_.write(row.finish()); }
  Expected<void> write(std::span<const double> values);  ///< at most Row::kMostFields

  Expected<void> commit() { return file_.commit(); }
  void abandon() noexcept { file_.abandon(); }

 private:
  explicit CsvFile(AtomicFile&& file) : file_(std::move(file)) {}

  AtomicFile file_;
};

}  // namespace twin::results

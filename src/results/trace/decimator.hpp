#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"

namespace twin::results {

/// Rows of numbers in memory, row after row.
struct Table {
  std::size_t columns = 0;
  std::vector<double> values;  ///< (rows x columns)

  std::size_t rows() const noexcept { return columns == 0 ? 0 : values.size() / columns; }
  double at(std::size_t row, std::size_t column) const noexcept {
    return values[row * columns + column];
  }
  std::span<const double> row(std::size_t index) const noexcept {
    return {values.data() + index * columns, columns};
  }
};

/// Thins a stream of rows for a picture: bounded memory, and no peak is lost.
///
/// Up to max_rows rows all are kept. Beyond, the stream is cut into buckets of 2^k successive rows,
/// and of each bucket the first row and, for each watched column, the rows of its smallest and
/// largest value remain. When the buckets would need more than max_rows rows, neighbours are merged
/// and k grows by one. The last row is always kept. The extremes of every watched column over the
/// whole stream are therefore those of the result.
class Decimator {
 public:
  /// @param columns   numbers in a row
  /// @param watched   columns whose extremes are kept
  /// @param max_rows  most rows of the result, at least 4 (2 + number of watched columns)
  Decimator(std::size_t columns, std::vector<std::size_t> watched, std::size_t max_rows);

  void push(std::span<const double> row);

  /// The rows that were kept, in the order in which they came. Ends the use of this object.
  Table finish();

 private:
  std::size_t slots() const noexcept { return 1 + 2 * watched_.size(); }
  void open_bucket(std::span<const double> row);
  void extend_bucket(std::size_t bucket, std::size_t index, std::span<const double> row);
  void absorb(std::size_t into, std::size_t from);
  void merge_neighbours();
  void fold();
  std::span<double> slot_row(std::size_t bucket, std::size_t slot) noexcept;

  std::size_t columns_;
  std::vector<std::size_t> watched_;
  std::size_t max_rows_;
  std::size_t max_buckets_;
  std::size_t count_ = 0;        // rows so far
  std::size_t bucket_size_ = 1;  // rows a bucket
  bool is_folded_ = false;
  std::vector<double> kept_;        // all rows while there are few; later the rows of the slots
  std::vector<std::size_t> index_;  // of each slot's row in the stream (buckets x slots)
  std::vector<double> last_;
};

/// The named columns of a CSV file, thinned to at most max_rows rows with the extremes of all
/// columns kept.
Expected<Table> load_decimated(const std::filesystem::path& file,
                               std::span<const std::string_view> columns, std::size_t max_rows);

}  // namespace twin::results

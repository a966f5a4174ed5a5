#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace twin::studies::compensate {

/// Symmetric matrix of which an element is 0 unless row and column are at most kBand apart.
class BandMatrix {
 public:
  static constexpr std::size_t kBand = 7;

  explicit BandMatrix(std::size_t size = 0) : rows_(size) {}

  std::size_t size() const noexcept { return rows_.size(); }
  /// Adds to an element and its mirror image, row >= column.
  void add(std::size_t row, std::size_t column, double value) { rows_[row][row - column] += value; }
  /// The product with a vector.
  std::vector<double> times(std::span<const double> x) const;
  /// Factors it in place into L D L'; it must be positive definite.
  void factor();
  /// Solves with the factors, in place.
  void solve(std::span<double> x) const;

 private:
  std::vector<std::array<double, kBand + 1>> rows_;  // of each row its diagonal, then leftwards
};

}  // namespace twin::studies::compensate

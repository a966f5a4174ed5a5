#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace twin::results {

/// Distribution of positive numbers over many decades, in a fixed amount of memory.
///
/// Bin k holds the numbers in [kLowest 2^(k/16), kLowest 2^((k+1)/16)). A quantile is therefore
/// known to 2^(1/16) - 1 = 4.4 %; the largest number is kept exactly. The range suits cycle times in
/// seconds: 1 ns to 18 s.
class LogHistogram {
 public:
  static constexpr double kLowest = 1e-9;
  static constexpr std::size_t kPerOctave = 16;
  static constexpr std::size_t kBins = 34 * kPerOctave;

  /// Counts one number; what is outside the range goes to the first or last bin. Real-time safe.
  void add(double x) noexcept;

  std::int64_t count() const noexcept { return count_; }
  double max() const noexcept { return max_; }
  /// How many numbers are in a bin. @param k  0 to kBins - 1
  std::uint32_t count_in(std::size_t k) const noexcept { return bins_[k]; }
  /// Lower end of a bin. @param k  0 to kBins
  static double lower_end(std::size_t k) noexcept;

  /// Number that the given fraction of all numbers does not exceed, to within one bin; never above
  /// max().
  /// @param fraction  0 to 1 @returns the quantile, 0 if nothing was counted
  double quantile(double fraction) const noexcept;

 private:
  std::array<std::uint32_t, kBins> bins_{};
  std::int64_t count_ = 0;
  double max_ = 0.0;
};

}  // namespace twin::results

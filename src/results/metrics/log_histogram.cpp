#include "results/metrics/log_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace twin::results {

void LogHistogram::add(double x) noexcept {
  const double octaves = x > kLowest ? std::log2(x / kLowest) : 0.0;
  const double bin = std::min(octaves * kPerOctave, static_cast<double>(kBins - 1));
  ++bins_[static_cast<std::size_t>(bin)];
  ++count_;
  max_ = std::max(max_, x);
}

double LogHistogram::lower_end(std::size_t k) noexcept {
  return kLowest * std::exp2(static_cast<double>(k) / kPerOctave);
}

double LogHistogram::quantile(double fraction) const noexcept {
  if (count_ == 0) {
    return 0.0;
  }
  const double wanted = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(count_);
  double seen = 0.0;
  for (std::size_t k = 0; k < kBins; ++k) {
    seen += bins_[k];
    if (bins_[k] > 0 && seen >= wanted) {
      return std::min(lower_end(k + 1), max_);
    }
  }
  return max_;
}

}  // namespace twin::results

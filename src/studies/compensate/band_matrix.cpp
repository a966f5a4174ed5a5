#include "studies/compensate/band_matrix.hpp"

#include <algorithm>

namespace twin::studies::compensate {

std::vector<double> BandMatrix::times(std::span<const double> x) const {
  std::vector<double> out(x.size(), 0.0);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    out[i] += rows_[i][0] * x[i];
    for (std::size_t d = 1; d <= std::min(kBand, i); ++d) {
      out[i] += rows_[i][d] * x[i - d];
      out[i - d] += rows_[i][d] * x[i];
    }
  }
  return out;
}

void BandMatrix::factor() {
  // Row i of L from the rows before it: l_ij d_j = a_ij - sum_m l_im d_m l_jm.
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const std::size_t first = i - std::min(kBand, i);
    for (std::size_t j = first; j < i; ++j) {
      double sum = rows_[i][i - j];
      for (std::size_t m = std::max(first, j - std::min(kBand, j)); m < j; ++m) {
        sum -= rows_[i][i - m] * rows_[j][j - m];  // l_im d_m is kept until the row is done
      }
      rows_[i][i - j] = sum;
    }
    for (std::size_t j = first; j < i; ++j) {
      const double scaled = rows_[i][i - j] / rows_[j][0];
      rows_[i][0] -= rows_[i][i - j] * scaled;
      rows_[i][i - j] = scaled;
    }
  }
}

void BandMatrix::solve(std::span<double> x) const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    for (std::size_t d = 1; d <= std::min(kBand, i); ++d) {
      x[i] -= rows_[i][d] * x[i - d];
    }
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    x[i] /= rows_[i][0];
  }
  for (std::size_t i = rows_.size(); i-- > 0;) {
    for (std::size_t d = 1; d <= std::min(kBand, i); ++d) {
      x[i - d] -= rows_[i][d] * x[i];
    }
  }
}

}  // namespace twin::studies::compensate

#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace twin::studies::identify::test {

/// Samples of amplitude sin(2 pi frequency t + phase), one a period [s, Hz, rad].
inline std::vector<double> sine(std::size_t rows, double period, double frequency, double amplitude,
                                double phase = 0.0) {
  std::vector<double> values(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    values[k] =
        amplitude *
        std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(k) * period + phase);
  }
  return values;
}

}  // namespace twin::studies::identify::test

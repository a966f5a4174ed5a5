#include "studies/identify/quantum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::studies::identify {
namespace quantum_test {

constexpr double kQuantum = 6.76e-3;  // [mm]

/// A motion at several velocities in whole counts.
std::vector<double> counted_motion() {
  std::vector<double> values;
  for (int k = 0; k < 5000; ++k) {
    const double x = 20.0 * std::pow(std::sin(0.0006 * k), 2) + 2.0 * std::sin(0.004 * k);
    values.push_back(kQuantum * std::round(x / kQuantum));
  }
  return values;
}

/// Replaces some rows by what lies on a straight line between the rows around them.
void interpolate(std::vector<double>& values, std::size_t every, std::size_t rows) {
  for (std::size_t k = every; k + rows + 1 < values.size(); k += every) {
    const double begin = values[k];
    const double step = (values[k + rows + 1] - begin) / static_cast<double>(rows + 1);
    for (std::size_t i = 1; i <= rows; ++i) {
      values[k + i] = begin + step * static_cast<double>(i);
    }
  }
}

TEST(Quantum, IsThatOfTheCounts) {
  EXPECT_NEAR(quantum_of(counted_motion()).value_or(0.0), kQuantum, 1e-6 * kQuantum);
}

TEST(Quantum, RowsInterpolatedOverLatePeriodsMakeNoSmallerCount) {
  for (const std::size_t rows : {1U, 2U, 3U, 5U}) {
    for (const std::size_t every : {400U, 97U, 41U}) {
      std::vector<double> values = counted_motion();
      interpolate(values, every, rows);
      EXPECT_NEAR(quantum_of(values).value_or(0.0), kQuantum, 0.02 * kQuantum)
          << rows << " rows in " << every;
    }
  }
}

TEST(Quantum, OfASignalThatIsNotRoundedIsNoneAndItsSmallestStepIsKnown) {
  std::vector<double> values;
  for (int k = 0; k < 3000; ++k) {
    values.push_back(10.0 * std::sin(0.002 * k) + 0.3 * std::sin(0.37 * k));
  }
  EXPECT_FALSE(quantum_of(values));
  EXPECT_GT(smallest_step(values).value_or(0.0), 0.0);
  EXPECT_FALSE(smallest_step(std::vector<double>(100, 1.0)));
}

}  // namespace quantum_test
}  // namespace twin::studies::identify

#include "studies/identify/direct.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/studies/identify/sine.hpp"

namespace twin::studies::identify {
namespace direct_test {

using test::sine;

TEST(Spectrum, FindsAToneBesideASlowMotionAndSaysItsPhase) {
  std::vector<double> values = sine(8000, 1e-3, 1.3, 0.5);
  const std::vector<double> tone = sine(8000, 1e-3, 59.87, 0.004, 0.7);
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] += tone[k];
  }
  const auto found = strongest_tone(values, 1e-3, 15.0, 420.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->frequency, 59.87, 1e-3);
  EXPECT_NEAR(found->amplitude, 0.004, 4e-6);
  EXPECT_NEAR(found->phase, 0.7, 0.02);
}

TEST(Spectrum, FindsNoneWhereNoneStandsOut) {
  std::vector<double> values;
  unsigned state = 1;
  for (int k = 0; k < 8000; ++k) {
    state = state * 1664525U + 1013904223U;
    values.push_back(static_cast<double>(state) / 4294967296.0 - 0.5);
  }
  EXPECT_FALSE(strongest_tone(values, 1e-3, 15.0, 420.0));
}

}  // namespace direct_test
}  // namespace twin::studies::identify

#include "hal/mujoco/delay_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace twin::hal::mujoco {
namespace delay_line_test {

TEST(DelayLine, ValuesComeOutTheGivenNumberOfStepsLater) {
  for (const std::size_t delay : {0U, 1U, 3U, 10U}) {
    DelayLine line(static_cast<double>(delay));
    for (std::size_t k = 0; k < 50; ++k) {
      const double expected = k < delay ? 0.0 : static_cast<double>(k - delay + 1);
      EXPECT_EQ(line.step(static_cast<double>(k + 1)), expected);
    }
  }
}

TEST(DelayLine, PartOfAStepIsTheMeanOfTheTwoValuesItSees) {
  for (const double delay : {0.25, 1.5, 3.75}) {
    DelayLine line(delay);
    for (int k = 0; k < 50; ++k) {
      // The mean over [k, k + 1] of the staircase w(t) = floor(t) + 1, t >= 0, seen delay later:
      // the integral of w is a polygon, exact at any time.
      const auto integral = [](double t) {
        const double whole = std::floor(std::max(t, 0.0));
        return whole * (whole + 1.0) / 2.0 + (std::max(t, 0.0) - whole) * (whole + 1.0);
      };
      EXPECT_NEAR(line.step(k + 1.0), integral(k + 1.0 - delay) - integral(k - delay), 1e-12);
    }
  }
}

TEST(DelayLine, RoundingOfTheQuotientMakesNoPartOfAStep) {
  DelayLine line(0.3e-3 / 1e-4);  // 2.9999999999999996
  for (int k = 0; k < 10; ++k) {
    EXPECT_EQ(line.step(k + 1.0), k < 3 ? 0.0 : k - 2.0);
  }
}

TEST(DelayLine, ClearedLineGivesZerosAgain) {
  DelayLine line(2);
  line.step(5.0);
  line.step(6.0);
  line.clear();
  EXPECT_EQ(line.step(7.0), 0.0);
  EXPECT_EQ(line.step(8.0), 0.0);
  EXPECT_EQ(line.step(9.0), 7.0);
}

}  // namespace delay_line_test
}  // namespace twin::hal::mujoco

#include "hal/mujoco/delay_line.hpp"

#include <gtest/gtest.h>

namespace twin::hal {
namespace {

TEST(DelayLine, ValuesComeOutTheGivenNumberOfStepsLater) {
  for (const std::size_t delay : {0U, 1U, 3U, 10U}) {
    DelayLine line(delay);
    for (std::size_t k = 0; k < 50; ++k) {
      const double expected = k < delay ? 0.0 : static_cast<double>(k - delay + 1);
      EXPECT_EQ(line.step(static_cast<double>(k + 1)), expected);
    }
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

}  // namespace
}  // namespace twin::hal

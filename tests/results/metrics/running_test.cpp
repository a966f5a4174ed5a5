#include "results/metrics/running.hpp"

#include <gtest/gtest.h>

namespace twin::results {
namespace running_test {

TEST(Running, FiguresOfOneToHundred) {
  Running running;
  for (int i = 1; i <= 100; ++i) {
    running.add(i);
  }
  EXPECT_EQ(running.count(), 100);
  EXPECT_EQ(running.min(), 1.0);
  EXPECT_EQ(running.max(), 100.0);
  EXPECT_DOUBLE_EQ(running.mean(), 50.5);
  EXPECT_DOUBLE_EQ(running.rms(), std::sqrt(101.0 * 201.0 / 6.0));
}

TEST(Running, SumOfManySmallNumbersLosesNothing) {
  Running running;
  for (int i = 0; i < 3000000; ++i) {
    running.add(0.1);
  }
  EXPECT_DOUBLE_EQ(running.sum(), 300000.0);
  EXPECT_DOUBLE_EQ(running.rms(), 0.1);
}

TEST(Running, EmptyIsZero) {
  const Running running;
  EXPECT_EQ(running.max(), 0.0);
  EXPECT_EQ(running.min(), 0.0);
  EXPECT_EQ(running.rms(), 0.0);
}

TEST(Running, NotANumberIsNotSwallowed) {
  Running running;
  running.add(1.0);
  running.add(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(running.rms()));
}

}  // namespace running_test
}  // namespace twin::results

#include "pictures/figure/value_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::pictures {
namespace value_range_test {

TEST(ValueRange, StepsAreRoundAndFew) {
  EXPECT_DOUBLE_EQ(tic_step({0.0, 50.0}), 10.0);
  EXPECT_DOUBLE_EQ(tic_step({-53.0, 48.0}), 20.0);
  EXPECT_DOUBLE_EQ(tic_step({0.0, 25.6}), 5.0);
  EXPECT_DOUBLE_EQ(tic_step({0.0, 0.003}), 0.0005);
  for (double high = 0.01; high < 1e4; high *= 1.07) {
    const double step = tic_step({0.0, high});
    EXPECT_LE(high / step, 6.0 + 1e-9);
    EXPECT_GE(high / step, 2.4 - 1e-9);
    const double digit = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-9 || std::abs(digit - 2) < 1e-9 ||
                std::abs(digit - 5) < 1e-9)
        << step;
  }
}

TEST(ValueRange, AxisHoldsAllValues) {
  EXPECT_EQ(y_axis({-53.0, 48.0}), "  set yrange [-60:60]\n  set ytics 20\n");
  EXPECT_EQ(y_axis({0.0, 20.0}), "  set yrange [0:20]\n  set ytics 5\n");
}

TEST(ValueRange, AxisOfValuesThatAreAllZeroHasALength) {
  EXPECT_EQ(y_axis({0.0, 0.0}), "  set yrange [0:1]\n  set ytics 0.2\n");
}

TEST(ValueRange, IsThatOfAColumnAndZero) {
  const results::Table table{2, {1.0, -3.0, 2.0, -5.0, 3.0, -4.0}};
  EXPECT_EQ(range_of(table, 0).low, 0.0);
  EXPECT_EQ(range_of(table, 0).high, 3.0);
  EXPECT_EQ(range_of(table, 1).low, -5.0);
  EXPECT_EQ(range_of(table, 1).high, 0.0);
}

}  // namespace value_range_test
}  // namespace twin::pictures

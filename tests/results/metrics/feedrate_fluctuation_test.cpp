#include "results/metrics/feedrate_fluctuation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::results {
namespace feedrate_fluctuation_test {

constexpr double kPeriod = 1e-3;

/// Circle of 1 mm radius, gone round with v(t) = 40 + 8 sin(50 t) mm/s; `error` shifts every other
/// set point along the path [mm].
Running on_circle(double error) {
  FeedrateFluctuation fluctuation(kPeriod);
  for (int i = 0; i < 400; ++i) {
    const double t = i * kPeriod;
    const double s =
        40.0 * t + 8.0 / 50.0 * (1.0 - std::cos(50.0 * t)) + (i % 2 == 0 ? error : 0.0);
    fluctuation.add({std::cos(s), std::sin(s), 0.0}, 40.0 + 8.0 * std::sin(50.0 * t));
  }
  return fluctuation.shares();
}

TEST(FeedrateFluctuation, IsNoneWhereTheSetPointsKeepToTheFeedrate) {
  const Running shares = on_circle(0.0);
  EXPECT_EQ(shares.count(), 395);
  EXPECT_LT(shares.max(), 3e-6);
}

TEST(FeedrateFluctuation, IsTheShareByWhichAPeriodIsLongOrShort) {
  const Running shares = on_circle(4e-4);  // a hundredth of 0.04 mm
  EXPECT_NEAR(shares.max(), 4e-4 / 0.032, 2e-4);
  EXPECT_NEAR(shares.rms(), 0.01, 3e-4);
}

TEST(FeedrateFluctuation, LeavesOutCorners) {
  FeedrateFluctuation fluctuation(kPeriod);
  for (int i = 0; i <= 40; ++i) {
    const double s = 0.0203 * i;
    const double corner = 0.4;
    fluctuation.add({std::min(s, corner), std::max(s - corner, 0.0), 0.0}, 20.3);
  }
  EXPECT_GT(fluctuation.shares().count(), 30);
  EXPECT_LT(fluctuation.shares().max(), 1e-9);
}

TEST(FeedrateFluctuation, LeavesOutRest) {
  FeedrateFluctuation fluctuation(kPeriod);
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(fluctuation.add({0.4, 0.412, 0.0}, 0.0));
  }
  EXPECT_EQ(fluctuation.shares().count(), 0);
}

TEST(FeedrateFluctuation, CountsNothingThatAStepOfJerkBetweenSetPointsExplains) {
  FeedrateFluctuation fluctuation(kPeriod);
  constexpr double kJerk = 50000.0;
  constexpr double kBegin = 0.01037;  // inside a period [s]
  for (int i = 0; i < 40; ++i) {
    const double t = std::max(i * kPeriod - kBegin, 0.0);
    const double s = 5.0 * i * kPeriod + kJerk * t * t * t / 6.0;
    fluctuation.add({s, 0.0, 0.0}, 5.0 + kJerk * t * t / 2.0);
  }
  EXPECT_EQ(fluctuation.shares().count(), 35);
  EXPECT_LT(fluctuation.shares().max(), 1e-9);
}

}  // namespace feedrate_fluctuation_test
}  // namespace twin::results

#include "studies/reproduce/sensitive_corners.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::studies::reproduce {
namespace sensitive_corners_test {

/// A motion at 50 mm/s from rest to rest along X with dips of a depth [mm/s] around some times.
std::vector<Moment> motion_with_dips(const std::vector<double>& times, double depth) {
  std::vector<Moment> motion;
  for (int i = 0; i <= 10000; ++i) {
    const double t = 1e-3 * i;
    double feedrate = std::min({50.0, 500.0 * t, 500.0 * (10.0 - t)});
    for (const double dip : times) {
      feedrate -= depth * std::max(0.0, 1.0 - std::abs(t - dip) / 0.1);
    }
    motion.push_back({t, {t, 0.0}, feedrate});
  }
  return motion;
}

TEST(SensitiveCorners, AreTheDipsInTheOrderOfMotion) {
  const auto corners = sensitive_corners(motion_with_dips({2.0, 3.5, 8.0}, 30.0), 7.5);
  ASSERT_EQ(corners.size(), 3U);
  EXPECT_NEAR(corners[0].t, 2.0, 1e-9);
  EXPECT_NEAR(corners[1].t, 3.5, 1e-9);
  EXPECT_NEAR(corners[2].t, 8.0, 1e-9);
  EXPECT_NEAR(corners[2].feedrate, 20.0, 1e-9);
  EXPECT_NEAR(corners[2].point.x(), 8.0, 1e-9);
}

TEST(SensitiveCorners, StartAndEndAreNone) {
  EXPECT_TRUE(sensitive_corners(motion_with_dips({}, 0.0), 7.5).empty());
  EXPECT_TRUE(sensitive_corners({}, 7.5).empty());
}

TEST(SensitiveCorners, ShallowDipsAreNone) {
  EXPECT_TRUE(sensitive_corners(motion_with_dips({3.0}, 7.0), 7.5).empty());
  EXPECT_EQ(sensitive_corners(motion_with_dips({3.0}, 8.0), 7.5).size(), 1U);
}

TEST(SensitiveCorners, RippleAtTheBottomOfADipMakesNoSecondCorner) {
  auto motion = motion_with_dips({3.0}, 30.0);
  for (Moment& moment : motion) {
    moment.feedrate += 1.5 * std::sin(400.0 * moment.t);
  }
  EXPECT_EQ(sensitive_corners(motion, 7.5).size(), 1U);
}

TEST(SensitiveCorners, MostViolentStretchHoldsTheDips) {
  const Window window = most_violent(motion_with_dips({2.0, 6.0, 6.5}, 30.0), 1.0);
  EXPECT_NEAR(window.end - window.begin, 1.0, 1e-9);
  EXPECT_LE(window.begin, 5.95);
  EXPECT_GE(window.end, 6.55);
}

TEST(SensitiveCorners, MostViolentStretchLeavesStartAndEndOut) {
  const Window window = most_violent(motion_with_dips({5.0}, 20.0), 1.0);
  EXPECT_LT(window.begin, 5.0);
  EXPECT_GT(window.end, 5.0);
}

TEST(SensitiveCorners, LettersGoOnAfterZ) {
  EXPECT_EQ(corner_letter(0), "A");
  EXPECT_EQ(corner_letter(25), "Z");
  EXPECT_EQ(corner_letter(26), "A2");
  EXPECT_EQ(corner_letter(53), "B3");
}

}  // namespace sensitive_corners_test
}  // namespace twin::studies::reproduce

#include "feedrate/limits/corners.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/units.hpp"

namespace twin::feedrate {
namespace corners_test {

constexpr double kPi = std::numbers::pi;
constexpr PlanningModel kTable2{313.95, 0.0, 0.005, 0.01};

TEST(CornerLimit, OfTheCriticalAngleAtTable2Is3000MillimetresPerMinute) {
  const double turn = kPi - units::rad_from_deg(172.8);
  EXPECT_NEAR(corner_model_feedrate(turn, 0.01, kTable2), 50.0, 0.005);
}

TEST(CornerLimit, OfARightAngleAndAReversalFollowsEquation16) {
  EXPECT_NEAR(corner_model_feedrate(0.5 * kPi, 0.01, kTable2), 3.1395 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(corner_model_feedrate(kPi, 0.01, kTable2), 3.1395, 1e-9);
}

TEST(CornerLimit, OfNoCornerIsNone) {
  EXPECT_TRUE(std::isinf(corner_model_feedrate(0.0, 0.01, kTable2)));
  EXPECT_TRUE(std::isinf(corner_acceleration_feedrate(0.0, 0.0, 2450.0, 1e-3)));
  EXPECT_TRUE(std::isinf(corner_ripple_feedrate(0.0, 50000.0, 1e-3)));
}

TEST(CornerLimit, ChangesTheVelocityVectorByATBetweenLines) {
  for (double turn = 0.01; turn < kPi; turn += 0.1) {
    for (const double period : {0.125e-3, 1e-3, 4e-3}) {
      const double v = corner_acceleration_feedrate(turn, 0.0, 2450.0, period);
      const double vx = v * std::cos(turn) - v;
      const double vy = v * std::sin(turn);
      EXPECT_NEAR(std::hypot(vx, vy), 2450.0 * period, 1e-9);
    }
  }
}

TEST(CornerLimit, BesideABendChangesTheVelocityVectorByATWithIt) {
  for (const double curvature : {0.01, 0.5, 5.0}) {
    for (const double turn : {0.0, 0.05, 1.0, 3.0}) {
      const double v = corner_acceleration_feedrate(turn, curvature, 2450.0, 1e-3);
      EXPECT_NEAR(curvature * v * v * 1e-3 + 2.0 * v * std::sin(0.5 * turn), 2.45, 1e-12);
    }
  }
}

TEST(CornerLimit, OfABendAloneIsItsNormalAcceleration) {
  EXPECT_NEAR(corner_acceleration_feedrate(0.0, 0.5, 2450.0, 1e-3), std::sqrt(4900.0), 1e-9);
}

TEST(CornerLimit, RippleShortensTheChordByLittleAgainstJerk) {
  // Straight on, a corner of `turn` half way through the period: the chord is shorter than v T by
  // v T (1 - cos(turn / 2)); four of that over T^3 stay below 4/10 J.
  for (const double turn : {0.01, 0.1, 0.5}) {
    const double period = 1e-3;
    const double v = corner_ripple_feedrate(turn, 50000.0, period);
    const double shorter = v * period * (1.0 - std::cos(0.5 * turn));
    EXPECT_LE(4.0 * shorter / (period * period * period), 0.4 * 50000.0 / 4.0 * 1.01);
  }
}

}  // namespace corners_test
}  // namespace twin::feedrate

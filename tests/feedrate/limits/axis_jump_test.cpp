#include <gtest/gtest.h>

#include <cmath>

#include "feedrate/limits/corners.hpp"

namespace twin::feedrate {
namespace axis_jump_test {

constexpr double kPeriod = 1e-3;

path::PathPoint along_x(double curvature) {
  path::PathPoint at;
  at.curvature = {0.0, curvature, 0.0};
  return at;
}

TEST(AxisJumpLimit, ACurvatureThatJumpsIsACornerWhereTheJerkOfAnAxisIsLimited) {
  Limits limits;
  EXPECT_TRUE(std::isinf(axis_jump_limit(along_x(0.0), along_x(0.1), limits, kPeriod).limit));
  limits.axis_jerk = {30000.0, 30000.0, 0.0};
  const double v = axis_jump_limit(along_x(0.0), along_x(0.1), limits, kPeriod).limit;
  // The acceleration of Y changes by 0.1 v^2 within a period.
  EXPECT_LE(0.1 * v * v / kPeriod, 0.25 * 30000.0 * (1.0 + 1e-12));
  EXPECT_GE(0.1 * v * v / kPeriod, 0.25 * 30000.0 * (1.0 - 1e-12));
}

TEST(AxisJumpLimit, NothingLimitsACurvatureThatGoesOn) {
  Limits limits;
  limits.axis_acceleration = {500.0, 500.0, 0.0};
  limits.axis_jerk = {30000.0, 30000.0, 0.0};
  EXPECT_TRUE(std::isinf(axis_jump_limit(along_x(0.1), along_x(0.1), limits, kPeriod).limit));
}

TEST(AxisJumpLimit, AKinkChangesTheVelocityOfAnAxisByAShareOfItsAcceleration) {
  Limits limits;
  limits.axis_acceleration = {500.0, 500.0, 0.0};
  path::PathPoint after = along_x(0.0);
  after.tangent = {std::cos(1e-2), std::sin(1e-2), 0.0};
  const double v = axis_jump_limit(along_x(0.0), after, limits, kPeriod).limit;
  EXPECT_NEAR(std::sin(1e-2) * v / kPeriod, 0.25 * 500.0, 1e-9);
}

}  // namespace axis_jump_test
}  // namespace twin::feedrate

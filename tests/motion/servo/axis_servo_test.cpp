#include "motion/servo/axis_servo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace twin::motion {
namespace axis_servo_test {

constexpr double kPeriod = 1e-3;  // [s]
constexpr double kScale = 80.0;   // [mm/s/V]

Gains only_kp(double kp) {
  Gains gains;
  gains.kp = kp;
  gains.kf = 0.0;
  return gains;
}

TEST(AxisServo, ProportionalPartIsKpTimesErrorOverScale) {
  AxisServo servo(only_kp(200.0), kScale, kPeriod);
  EXPECT_DOUBLE_EQ(servo.update({10.5, 0.0, 0.0}, 10.1), 200.0 * 0.4 / kScale);
  EXPECT_NEAR(servo.error(), 0.4, 1e-12);
}

TEST(AxisServo, FeedforwardCommandsTheSetPointsOwnVelocityWithoutError) {
  Gains gains = only_kp(100.0);
  gains.kf = 1.0;
  gains.ka = 2e-3;
  AxisServo servo(gains, kScale, kPeriod);
  EXPECT_DOUBLE_EQ(servo.update({3.0, 40.0, 1000.0}, 3.0), (40.0 + 2.0) / kScale);
}

TEST(AxisServo, DerivativeOfARampIsItsSlopeFromTheSecondPeriodOn) {
  Gains gains = only_kp(0.0);
  gains.kd = 0.5;
  AxisServo servo(gains, kScale, kPeriod);
  EXPECT_DOUBLE_EQ(servo.update({1.0, 0.0, 0.0}, 0.0), 0.0);
  for (int k = 1; k < 5; ++k) {
    const double ramp = 1.0 + 0.02 * k;  // 20 mm/s
    EXPECT_NEAR(servo.update({ramp, 0.0, 0.0}, 0.0), 0.5 * 20.0 / kScale, 1e-12);
  }
  servo.reset();
  EXPECT_DOUBLE_EQ(servo.update({9.0, 0.0, 0.0}, 0.0), 0.0);
}

TEST(AxisServo, ReversedDriveScaleReversesTheVolts) {
  AxisServo forward(only_kp(100.0), kScale, kPeriod);
  AxisServo reversed(only_kp(100.0), -kScale, kPeriod);
  EXPECT_DOUBLE_EQ(forward.update({1.0, 0.0, 0.0}, 0.5), -reversed.update({1.0, 0.0, 0.0}, 0.5));
}

TEST(AxisServo, CommandIsCutToTenVoltsAndSaysSo) {
  AxisServo servo(only_kp(100.0), kScale, kPeriod);
  EXPECT_EQ(servo.update({1000.0, 0.0, 0.0}, 0.0), 10.0);
  EXPECT_TRUE(servo.is_saturated());
  EXPECT_EQ(servo.update({-1000.0, 0.0, 0.0}, 0.0), -10.0);
  EXPECT_TRUE(servo.is_saturated());
  EXPECT_LT(std::abs(servo.update({0.1, 0.0, 0.0}, 0.0)), 10.0);
  EXPECT_FALSE(servo.is_saturated());
}

TEST(AxisServo, NotANumberGivesZeroVoltsAndCountsAsSaturated) {
  AxisServo servo(only_kp(100.0), kScale, kPeriod);
  EXPECT_EQ(servo.update({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, 0.0), 0.0);
  EXPECT_TRUE(servo.is_saturated());
}

TEST(AxisServo, TrimIsAddedInVolts) {
  Gains gains = only_kp(100.0);
  gains.trim_V = -0.012;
  AxisServo servo(gains, kScale, kPeriod);
  EXPECT_DOUBLE_EQ(servo.update({5.0, 0.0, 0.0}, 5.0), -0.012);
}

// On a plant that integrates its velocity command, the sampled loop e' = (1 - Kp T) e is exact.
TEST(AxisServo, ErrorOnAnIntegratorDecaysByOneMinusKpTEachPeriod) {
  AxisServo servo(only_kp(150.0), kScale, kPeriod);
  double position = 0.0;
  for (int k = 0; k < 20; ++k) {
    position += servo.update({1.0, 0.0, 0.0}, position) * kScale * kPeriod;
    EXPECT_NEAR(1.0 - position, std::pow(1.0 - 0.15, k + 1), 1e-12);
  }
}

TEST(AxisScaling, CountsAndVoltsFollowTheSignOfTheirScale) {
  EXPECT_DOUBLE_EQ(position_from_counts(-2000, 0.01), -20.0);
  EXPECT_DOUBLE_EQ(position_from_counts(-2000, -0.01), 20.0);
  EXPECT_DOUBLE_EQ(volts_from_velocity(-160.0, kScale), -2.0);
}

}  // namespace axis_servo_test
}  // namespace twin::motion

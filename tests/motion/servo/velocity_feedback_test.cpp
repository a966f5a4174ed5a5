#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "motion/servo/axis_servo.hpp"

namespace twin::motion {
namespace velocity_feedback_test {

constexpr double kPeriod = 1e-3;
constexpr double kScale = 10.0;  // [mm/s/V]

TEST(AxisServo, VelocityFeedbackIsTheMeanMeasuredVelocityOverItsPeriods) {
  const Gains gains{
      .kp = 0.0, .kd = 0.0, .kf = 0.0, .ka = 0.0, .trim_V = 0.0, .kv = 2.0, .kv_periods = 3};
  AxisServo servo(gains, kScale, kPeriod);
  double y = 0.0;
  std::array<double, 20> past{};
  for (std::size_t k = 0; k < past.size(); ++k) {
    past[k] = y;
    const double volts = servo.update({}, y);
    if (k >= 3) {
      EXPECT_NEAR(volts, -2.0 * (y - past[k - 3]) / (3.0 * kPeriod) / kScale, 1e-12) << k;
    }
    y += 1e-4 * static_cast<double>(k % 7);
  }
}

TEST(AxisServo, CommandDelayIsThatOfARampAndHoldsTheFirstSetPoint) {
  const Gains gains{.kp = 1.0,
                    .kd = 0.0,
                    .kf = 1.0,
                    .ka = 0.0,
                    .trim_V = 0.0,
                    .kv = 0.0,
                    .kv_periods = 1,
                    .command_delay = 2.5e-3};
  AxisServo servo(gains, kScale, kPeriod);
  for (int k = 0; k < 20; ++k) {
    const double volts = servo.update({0.5 * k, 0.3 * k, 0.0}, 0.0);
    const double late = std::max(k - 2.5, 0.0);
    EXPECT_NEAR(volts * kScale, k >= 3 ? 0.8 * late : volts * kScale, 1e-12) << k;
  }
}

TEST(AxisServo, BeginsInMotionWithoutAJump) {
  const Gains gains{.kp = 100.0,
                    .kd = 0.5,
                    .kf = 0.0,
                    .ka = 0.0,
                    .trim_V = 0.0,
                    .kv = 1.0,
                    .kv_periods = 2,
                    .command_delay = 1.5e-3};
  AxisServo settled(gains, kScale, kPeriod);
  AxisServo begun(gains, kScale, kPeriod);
  const double v = 20.0;
  const auto at = [&](int k) { return Reference{v * kPeriod * k, v, 0.0}; };
  for (int k = 0; k < 50; ++k) {
    settled.update(at(k), at(k).position - 0.1);
  }
  begun.begin_moving(at(49), at(49).position - 0.1, v);
  for (int k = 50; k < 60; ++k) {
    EXPECT_NEAR(begun.update(at(k), at(k).position - 0.1),
                settled.update(at(k), at(k).position - 0.1), 1e-9);
  }
}

}  // namespace velocity_feedback_test
}  // namespace twin::motion

#include "hal/mujoco/speed_feedback.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hal/mujoco/drive.hpp"

namespace twin::hal::mujoco {
namespace speed_feedback_test {

constexpr double kStep = 1e-4;  // [s]

TEST(SpeedFeedback, ContinuousLoopSeesTheSpeedAsItIs) {
  SpeedFeedback feedback(DriveParams{}, kStep);
  for (const double speed : {1.0, -3.5, 0.1}) {
    feedback.step(speed);
    EXPECT_EQ(feedback.speed(), speed);
    EXPECT_TRUE(feedback.is_sample());
  }
}

TEST(SpeedFeedback, SampledLoopSeesTheMeanOfTheLastPeriodAndHoldsIt) {
  DriveParams params;
  params.velocity_loop_period = 5 * kStep;
  SpeedFeedback feedback(params, kStep);
  feedback.reset();
  for (int i = 0; i < 100; ++i) {
    feedback.step(i);
    EXPECT_EQ(feedback.is_sample(), i % 5 == 0);
    if (i >= 5) {
      const int begin = i / 5 * 5 - 5;  // of the period that was over at the last sample
      EXPECT_DOUBLE_EQ(feedback.speed(), begin + 2.0);
    }
  }
}

TEST(SpeedFeedback, FilterAndDeadTimeAreThoseOfTheirClosedForms) {
  DriveParams params;
  params.speed_filter = 2e-3;
  params.speed_delay = 10 * kStep;
  SpeedFeedback feedback(params, kStep);
  for (int i = 0; i < 100; ++i) {
    feedback.step(1.0);
    const double passed = (i + 1 - 10) * kStep;
    EXPECT_NEAR(feedback.speed(), passed > 0.0 ? -std::expm1(-passed / params.speed_filter) : 0.0,
                1e-12);
  }
}

DriveSignals switched_on() {
  DriveSignals signals;
  signals.servo_on = true;
  return signals;
}

DriveParams plain(DriveMode mode) {
  DriveParams params;
  params.mode = mode;
  params.hum_amplitude = 0.0;
  params.ready_delay = 0.0;
  return params;
}

TEST(Drive, LoopWithoutIntegralPartLagsALoadByItsGain) {
  DriveParams params = plain(DriveMode::kSpeed);
  params.integral_time = 0.0;
  MotorParams motor;
  motor.current_lag = 0.0;
  const double inertia = 4e-5;
  Drive drive(params, motor, inertia, kStep);
  const double load = 0.05;  // [N.m]
  double speed = 0.0;
  for (int i = 0; i < 20000; ++i) {
    speed += kStep / inertia * (drive.step(1.0, speed, i * kStep, switched_on()) - load);
  }
  const double asked = params.vref_scale_rpm_per_V * 2.0 * M_PI / 60.0;
  const double gain = inertia * 2.0 * M_PI * params.velocity_gain_Hz;
  EXPECT_NEAR(speed, asked - load / gain, 1e-6 * asked);
}

TEST(Drive, TorqueModeGivesTorqueByItsScaleAndNoneTowardsALimitSwitch) {
  MotorParams motor;
  motor.current_lag = 0.0;
  Drive drive(plain(DriveMode::kTorque), motor, 4e-5, kStep, 0.25);
  EXPECT_DOUBLE_EQ(drive.step(2.0, 123.0, 0.0, switched_on()), 0.5);
  EXPECT_DOUBLE_EQ(drive.step(-2.0, 123.0, 0.0, switched_on()), -0.5);
  EXPECT_DOUBLE_EQ(drive.step(9.0, 0.0, 0.0, switched_on()), motor.peak_torque);
  DriveSignals signals = switched_on();
  signals.limit_positive = true;
  EXPECT_EQ(drive.step(2.0, 0.0, 0.0, signals), 0.0);
  EXPECT_DOUBLE_EQ(drive.step(-2.0, 0.0, 0.0, signals), -0.5);
}

TEST(Drive, BeginsInAMotionThatGoesOnAsIfItHadAlwaysBeen) {
  DriveParams params = plain(DriveMode::kSpeed);
  params.velocity_loop_period = 5 * kStep;
  const MotorParams motor;
  Drive drive(params, motor, 4e-5, kStep);
  const double speed = params.vref_scale_rpm_per_V * 2.0 * M_PI / 60.0;
  drive.begin_moving(1.0, speed, 0.3);
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(drive.step(1.0, speed, i * kStep, switched_on()), 0.3, 1e-9);
  }
}

}  // namespace speed_feedback_test
}  // namespace twin::hal::mujoco

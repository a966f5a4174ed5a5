#include "hal/mujoco/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace twin::hal::mujoco {
namespace drive_test {

constexpr double kPi = std::numbers::pi;

/// A drive without lag, delay and disturbance.
DriveParams plain_drive() {
  DriveParams params;
  params.hum_amplitude = 0.0;
  params.ready_delay = 0.0;
  return params;
}
MotorParams plain_motor() {
  MotorParams params;
  params.current_lag = 0.0;
  return params;
}

DriveSignals switched_on() {
  DriveSignals signals;
  signals.servo_on = true;
  return signals;
}

/// w(t) / w_ref of K (s + 1/Ti) / (s^2 + K s + K/Ti) after a unit step: with the poles p1, p2 of
/// the denominator, 1 + (p1 e^{p1 t} - p2 e^{p2 t}) / (p2 - p1).
double closed_form(double k, double ti, double t) {
  const std::complex<double> root = std::sqrt(std::complex<double>(k * k / 4.0 - k / ti, 0.0));
  const std::complex<double> p1 = -k / 2.0 + root;
  const std::complex<double> p2 = -k / 2.0 - root;
  return (1.0 + (p1 * std::exp(p1 * t) - p2 * std::exp(p2 * t)) / (p2 - p1)).real();
}

TEST(Drive, VelocityStepFollowsItsClosedForm) {
  for (const double gain_Hz : {30.0, 150.0}) {
    for (const double ti : {2e-3, 7e-3, 50e-3}) {
      DriveParams params = plain_drive();
      params.velocity_gain_Hz = gain_Hz;
      params.integral_time = ti;
      const double inertia = 4.1e-5;
      const double step = 1e-6;
      Drive drive(params, plain_motor(), inertia, step);
      const double reference = 500.0 * 2.0 * kPi / 60.0 * 0.1;  // of 0.1 V [rad/s]
      double speed = 0.0;
      for (int i = 0; i < 50000; ++i) {
        speed += step * drive.step(0.1, speed, i * step, switched_on()) / inertia;
        const double expected = closed_form(2.0 * kPi * gain_Hz, ti, (i + 1) * step);
        ASSERT_NEAR(speed / reference, expected, 2e-3) << gain_Hz << " Hz at step " << i;
      }
    }
  }
}

TEST(Drive, TorqueIsLimitedAndTheIntegralDoesNotWindUp) {
  DriveParams params = plain_drive();
  const MotorParams motor = plain_motor();
  const double inertia = 4.1e-5;
  const double step = 1e-5;
  Drive drive(params, motor, inertia, step);
  const double reference = 6.0 * 500.0 * 2.0 * kPi / 60.0;  // of 6 V: rated speed [rad/s]
  double speed = 0.0;
  double top = 0.0;
  double largest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double torque = drive.step(6.0, speed, i * step, switched_on());
    largest = std::max(largest, std::abs(torque));
    speed += step * torque / inertia;
    top = std::max(top, speed);
  }
  EXPECT_NEAR(largest, motor.peak_torque, 1e-9);
  EXPECT_NEAR(speed, reference, 1e-3 * reference);
  // Without a limit the linear loop overshoots by this much; a wound-up one by far more.
  double linear = 0.0;
  for (int i = 0; i < 20000; ++i) {
    linear = std::max(
        linear, closed_form(2.0 * kPi * params.velocity_gain_Hz, params.integral_time, i * step));
  }
  EXPECT_LT(top / reference, linear);
  EXPECT_FALSE(drive.has_alarm());
}

TEST(Drive, CurrentFollowsAfterItsTimeConstant) {
  MotorParams motor = plain_motor();
  motor.current_lag = 0.5e-3;
  DriveParams params = plain_drive();
  params.integral_time = 1e6;
  const double step = 1e-5;
  const double inertia = 4e-5;
  Drive drive(params, motor, inertia, step);
  const double final =
      inertia * 2.0 * kPi * params.velocity_gain_Hz * 500.0 * 2.0 * kPi / 60.0 * 0.01;
  double torque = 0.0;
  for (int i = 0; i < 50; ++i) {
    torque = drive.step(0.01, 0.0, i * step, switched_on());  // rotor held
  }
  EXPECT_NEAR(torque / final, 1.0 - std::exp(-1.0), 1e-3);
  EXPECT_NEAR(drive.current(), torque / motor.torque_constant, 1e-12);
}

TEST(Drive, HumAndOffsetOfVrefTurnTheMotor) {
  DriveParams params = plain_drive();
  params.vref_offset = 5e-3;
  params.hum_amplitude = 20e-3;
  params.hum_phase = kPi / 2.0;
  params.integral_time = 1e9;
  Drive drive(params, plain_motor(), 4e-5, 1e-4);
  const double per_volt = 4e-5 * 2.0 * kPi * params.velocity_gain_Hz * 500.0 * 2.0 * kPi / 60.0;
  EXPECT_NEAR(drive.step(0.0, 0.0, 0.0, switched_on()), 25e-3 * per_volt, 1e-9);
  EXPECT_NEAR(drive.step(0.0, 0.0, 0.5 / 60.0, switched_on()), -15e-3 * per_volt, 1e-9);
}

TEST(Drive, GivesNoTorqueWhileOffAndUntilItIsReady) {
  DriveParams params = plain_drive();
  params.ready_delay = 10e-3;
  const double step = 1e-4;
  Drive drive(params, plain_motor(), 4e-5, step);
  EXPECT_EQ(drive.step(1.0, 0.0, 0.0, {}), 0.0);
  int steps = 0;
  while (drive.step(1.0, 0.0, steps * step, switched_on()) == 0.0 && steps < 1000) {
    ++steps;
  }
  EXPECT_NEAR(steps * step, params.ready_delay, 1.5 * step);
  EXPECT_TRUE(drive.is_ready());
  EXPECT_EQ(drive.step(1.0, 0.0, 1.0, {}), 0.0);
  EXPECT_FALSE(drive.is_ready());
}

TEST(Drive, LimitSwitchLetsOnlyTheWayBackThrough) {
  Drive drive(plain_drive(), plain_motor(), 4e-5, 1e-4);
  DriveSignals signals = switched_on();
  signals.limit_positive = true;
  EXPECT_EQ(drive.step(1.0, 0.0, 0.0, signals), 0.0);
  EXPECT_LT(drive.step(-1.0, 0.0, 0.0, signals), 0.0);
  drive.reset();
  signals.limit_positive = false;
  signals.limit_negative = true;
  EXPECT_EQ(drive.step(-1.0, 0.0, 0.0, signals), 0.0);
  EXPECT_GT(drive.step(1.0, 0.0, 0.0, signals), 0.0);
}

TEST(Drive, BlockedMotorRaisesAnAlarmThatStaysUntilReset) {
  DriveParams params = plain_drive();
  params.overload_time = 0.1;
  const double step = 1e-4;
  Drive drive(params, plain_motor(), 4e-5, step);
  int steps = 0;
  while (!drive.has_alarm() && steps < 10000) {
    drive.step(6.0, 0.0, steps * step, switched_on());
    ++steps;
  }
  EXPECT_NEAR(steps * step, 0.1, 2e-3);
  EXPECT_EQ(drive.step(6.0, 0.0, 1.0, switched_on()), 0.0);
  EXPECT_TRUE(drive.has_alarm());
  drive.reset();
  EXPECT_FALSE(drive.has_alarm());
  EXPECT_GT(drive.step(6.0, 0.0, 1.0, switched_on()), 0.0);
}

}  // namespace drive_test
}  // namespace twin::hal::mujoco

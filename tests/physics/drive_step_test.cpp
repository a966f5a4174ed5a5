#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <ostream>

#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/table_files.hpp"

// The table's velocity after a step of the drive command, without friction and disturbance.
namespace twin::hal::mujoco {
namespace drive_step_test {

using Complex = std::complex<double>;

struct Case {
  double gain_Hz;        // of the velocity loop
  double integral_time;  // Ti [s]
  double current_lag;    // tau [s]
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.gain_Hz << " Hz, Ti " << 1e3 * c.integral_time << " ms, lag " << 1e3 * c.current_lag
       << " ms";
}

/// Roots of s^3 + a s^2 + b s + c, all at once (Weierstrass).
std::array<Complex, 3> cubic_roots(double a, double b, double c) {
  const double scale = std::max({std::abs(a), std::sqrt(std::abs(b)), std::cbrt(std::abs(c))});
  std::array<Complex, 3> r{scale * Complex(0.4, 0.9), scale * Complex(-0.65, 0.72),
                           scale * Complex(-0.98, -0.1)};
  for (int i = 0; i < 500; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Complex value = ((r[k] + a) * r[k] + b) * r[k] + c;
      r[k] -= value / ((r[k] - r[(k + 1) % 3]) * (r[k] - r[(k + 2) % 3]));
    }
  }
  return r;
}

/// w(t) / w_ref after a unit step. With K = 2 pi f, PI loop, current lag tau and bare inertia
///   w / w_ref = K (s + 1/Ti) / (tau s^3 + s^2 + K s + K/Ti),
/// in partial fractions over the poles p_i: 1 + sum of N(p_i) / (p_i D'(p_i)) exp(p_i t).
double closed_form(const Case& c, double t) {
  const double k = 2.0 * std::numbers::pi * c.gain_Hz;
  const double tau = c.current_lag;
  Complex w = 1.0;
  for (const Complex p : cubic_roots(1.0 / tau, k / tau, k / c.integral_time / tau)) {
    const Complex slope = 3.0 * tau * p * p + 2.0 * p + k;
    w += k * (p + 1.0 / c.integral_time) / (p * slope) * std::exp(p * t);
  }
  return w.real();
}

class VelocityStep : public ::testing::TestWithParam<Case> {};

TEST_P(VelocityStep, FollowsItsClosedFormWithinOnePercentOfTheFinalValue) {
  TableParams params = test::faultless_table();
  params.physics_step = 1e-5;
  for (AxisParams& axis : params.axis) {
    axis.drive.velocity_gain_Hz = GetParam().gain_Hz;
    axis.drive.integral_time = GetParam().integral_time;
    axis.drive.ready_delay = 0.0;
    axis.motor.current_lag = GetParam().current_lag;
  }
  const double period = 1e-4;
  MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(period)));
  ASSERT_TRUE(checked(machine.activate()));
  Outputs outputs;
  outputs.servo_on = {true, true};
  outputs.volts = {0.1, -0.1};
  const double final = 0.1 * machine.info().mm_per_s_per_volt[kX];
  Inputs inputs;
  double top = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    ASSERT_EQ(machine.write(outputs), Status::kOk);
    ASSERT_EQ(machine.read(inputs), Status::kOk);
    const double expected = closed_form(GetParam(), k * period);
    top = std::max(top, expected);
    ASSERT_NEAR(machine.velocity(kX) / final, expected, 0.01) << "at " << k * period << " s";
    ASSERT_NEAR(machine.velocity(kY) / -final, expected, 0.01) << "at " << k * period << " s";
  }
  EXPECT_GT(top, 1.05) << "a PI loop overshoots";
  EXPECT_NEAR(machine.velocity(kX) / final, 1.0, 0.01);
}

// The drives of xy_table.toml, X and Y, and a lazy current loop that rings.
INSTANTIATE_TEST_SUITE_P(Drives, VelocityStep,
                         ::testing::Values(Case{30.0, 7e-3, 0.45e-3}, Case{150.0, 10e-3, 0.45e-3},
                                           Case{80.0, 5e-3, 2e-3}));

}  // namespace drive_step_test
}  // namespace twin::hal::mujoco

#include "studies/identify/measured_parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/servo/axis_servo.hpp"
#include "tests/studies/identify/sine.hpp"

namespace twin::studies::identify {
namespace measured_parameters_test {

using test::sine;

TEST(Quantum, IsTheStepOfARoundedSignal) {
  for (const double quantum : {0.01, 0.00122, 1.0 / 3000.0}) {
    std::vector<double> values = sine(5000, 1e-3, 0.7, 20.0);
    for (double& value : values) {
      value = quantum * std::floor(value / quantum + 0.5);
    }
    const auto found = quantum_of(values);
    ASSERT_TRUE(found) << quantum;
    EXPECT_NEAR(*found, quantum, 1e-6 * quantum);
  }
}

TEST(Quantum, IsNotSeenInASmoothSignal) {
  EXPECT_FALSE(quantum_of(sine(5000, 1e-3, 0.7123, 20.0)));
  EXPECT_FALSE(quantum_of(std::vector<double>(1000, 1.0)));
}

TEST(GainFit, GivesBackTheGainsOfAServo) {
  const motion::Gains gains{120.0, 0.05, 1.004, 0.002, 0.01};
  constexpr double kScale = -83.3;
  motion::AxisServo servo(gains, kScale, 1e-3);
  AxisRecord record;
  for (int k = 0; k < 2000; ++k) {
    const double t = 1e-3 * k;
    const motion::Reference reference{10.0 * std::sin(3.0 * t), 30.0 * std::cos(3.0 * t),
                                      -90.0 * std::sin(3.0 * t)};
    const double measured = reference.position - 0.01 * std::sin(40.0 * t) + 0.003;
    record.command.push_back(reference);
    record.measured.push_back(measured);
    record.volts.push_back(servo.update(reference, measured));
  }
  const GainFit fit = fit_gains(std::vector<AxisRecord>{record}, kScale, 1e-3);
  EXPECT_NEAR(fit.gains.kp, gains.kp, 1e-4);
  EXPECT_NEAR(fit.gains.kd, gains.kd, 1e-6);
  EXPECT_NEAR(fit.gains.kf, gains.kf, 1e-6);
  EXPECT_NEAR(fit.gains.ka, gains.ka, 1e-6);
  EXPECT_NEAR(fit.gains.trim_V, gains.trim_V, 1e-6);
  EXPECT_LT(fit.rms_V, 1e-6);
}

}  // namespace measured_parameters_test
}  // namespace twin::studies::identify

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "studies/identify/gain_fit.hpp"
#include "studies/identify/quantum.hpp"
#include "studies/identify/spectrum.hpp"

namespace twin::studies::identify {
namespace direct_test {

std::vector<double> sine(std::size_t rows, double period, double frequency, double amplitude,
                         double phase = 0.0) {
  std::vector<double> values(rows);
  for (std::size_t k = 0; k < rows; ++k) {
    values[k] =
        amplitude *
        std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(k) * period + phase);
  }
  return values;
}

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

TEST(Spectrum, FindsAToneBesideASlowMotionAndSaysItsPhase) {
  std::vector<double> values = sine(8000, 1e-3, 1.3, 0.5);
  const std::vector<double> tone = sine(8000, 1e-3, 59.87, 0.004, 0.7);
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] += tone[k];
  }
  const auto found = strongest_tone(values, 1e-3, 15.0, 420.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->frequency, 59.87, 1e-3);
  EXPECT_NEAR(found->amplitude, 0.004, 4e-6);
  EXPECT_NEAR(found->phase, 0.7, 0.02);
}

TEST(Spectrum, FindsNoneWhereNoneStandsOut) {
  std::vector<double> values;
  unsigned state = 1;
  for (int k = 0; k < 8000; ++k) {
    state = state * 1664525U + 1013904223U;
    values.push_back(static_cast<double>(state) / 4294967296.0 - 0.5);
  }
  EXPECT_FALSE(strongest_tone(values, 1e-3, 15.0, 420.0));
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

}  // namespace direct_test
}  // namespace twin::studies::identify

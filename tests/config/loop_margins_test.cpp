#include "config/loop_margins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twin::config {
namespace loop_margins_test {

/// A drive that follows its command at once, but for the delay.
hal::mujoco::AxisParams ideal_axis(double delay) {
  hal::mujoco::AxisParams axis;
  axis.drive.velocity_gain_Hz = 1e7;
  axis.drive.integral_time = 1e3;
  axis.drive.input_lag = 0.0;
  axis.drive.output_delay = delay;
  axis.motor.current_lag = 0.0;
  return axis;
}

/// An integrator with gain Kp behind a pure delay D has its crossover at Kp, the phase margin
/// 90 deg - Kp D, and the gain margin (pi / 2) / (Kp D). The hold of a short period T adds T / 2.
TEST(LoopMargins, OfADelayAreThoseOfTheTextbook) {
  constexpr double kDelay = 4e-3;
  constexpr double kPeriod = 1e-4;
  motion::Gains gains;
  gains.kp = 100.0;
  const LoopMargins margins = loop_margins(gains, ideal_axis(kDelay), kPeriod);
  const double all = kDelay + 0.5 * kPeriod;
  EXPECT_NEAR(margins.crossover_Hz, gains.kp / (2.0 * std::numbers::pi), 0.02);
  EXPECT_NEAR(margins.phase_margin_deg, 90.0 - gains.kp * all * 180.0 / std::numbers::pi, 0.1);
  EXPECT_NEAR(margins.gain_margin, 0.5 * std::numbers::pi / (gains.kp * all), 5e-3);
  EXPECT_TRUE(margins.is_stable());
}

/// Without a delay the closed loop is a first-order lag, whose -3 dB are at Kp.
TEST(LoopMargins, BandwidthOfAFirstOrderLagIsItsGain) {
  motion::Gains gains;
  gains.kp = 50.0;
  const LoopMargins margins = loop_margins(gains, ideal_axis(0.0), 1e-5);
  EXPECT_NEAR(margins.bandwidth_Hz, gains.kp / (2.0 * std::numbers::pi), 0.02);
}

TEST(LoopMargins, TooMuchGainIsUnstable) {
  motion::Gains gains;
  gains.kp = 600.0;
  const LoopMargins margins = loop_margins(gains, ideal_axis(4e-3), 1e-3);
  EXPECT_FALSE(margins.is_stable());
  EXPECT_LT(margins.gain_margin, 1.0);
  EXPECT_LT(margins.phase_margin_deg, 0.0);
}

}  // namespace loop_margins_test
}  // namespace twin::config

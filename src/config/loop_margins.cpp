#include "config/loop_margins.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace twin::config {
namespace {

using Complex = std::complex<double>;

constexpr double kLowest = 0.1;   // of the search [rad/s]
constexpr double kStep = 1.0005;  // ratio of neighbouring frequencies
constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// L(jw).
Complex open_loop(const motion::Gains& gains, const hal::mujoco::AxisParams& axis, double period,
                  double w) {
  const Complex s(0.0, w);
  const hal::mujoco::DriveParams& drive = axis.drive;
  const Complex lost = 1.0 - std::exp(-s * period);
  const Complex servo = gains.kp + gains.kd * lost / period;
  const Complex hold = lost / (s * period);
  const Complex input = std::exp(-s * drive.output_delay) / (1.0 + drive.input_lag * s);
  const Complex velocity_loop = kTwoPi * drive.velocity_gain_Hz * (s + 1.0 / drive.integral_time) /
                                (s * s * (1.0 + axis.motor.current_lag * s));
  return servo * hold * input * velocity_loop / (1.0 + velocity_loop) / s;
}

}  // namespace

LoopMargins loop_margins(const motion::Gains& gains, const hal::mujoco::AxisParams& axis,
                         double period) {
  LoopMargins margins;
  margins.phase_margin_deg = 180.0;
  const double highest = std::numbers::pi / period;
  double w = kLowest;
  Complex before = open_loop(gains, axis, period, w);
  bool has_crossed = false;
  for (w *= kStep; w < highest; w *= kStep) {
    const Complex now = open_loop(gains, axis, period, w);
    if (!has_crossed && std::abs(before) >= 1.0 && std::abs(now) < 1.0) {
      has_crossed = true;
      margins.crossover_Hz = w / kTwoPi;
      // A lag beyond 180 deg has wrapped around to a phase above 0.
      const double phase = std::arg(now) * 360.0 / kTwoPi;
      margins.phase_margin_deg = phase > 0.0 ? phase - 180.0 : phase + 180.0;
    }
    if (margins.gain_margin == 0.0 && before.imag() < 0.0 && now.imag() >= 0.0 &&
        now.real() < 0.0) {
      margins.gain_margin = 1.0 / std::abs(now);
    }
    const auto follows = [](const Complex& loop) {
      return std::abs(loop / (1.0 + loop)) >= std::numbers::sqrt2 / 2.0;
    };
    if (follows(before) && !follows(now)) {
      margins.bandwidth_Hz = w / kTwoPi;
    }
    before = now;
  }
  if (margins.gain_margin == 0.0) {
    margins.gain_margin = INFINITY;
  }
  return margins;
}

}  // namespace twin::config

#include "config/loop_margins.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace twin::config {
namespace {

using Complex = std::complex<double>;

constexpr double kLowest = 0.1;      // of the search [rad/s]
constexpr double kStep = 1.0005;     // ratio of neighbouring frequencies
constexpr std::size_t kStride = 16;  // steps that are passed over where nothing happens
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

/// Whether the closed loop follows by more than -3 dB.
bool follows(const Complex& loop) {
  return std::abs(loop / (1.0 + loop)) >= std::numbers::sqrt2 / 2.0;
}

/// Whether the phase passes -180 deg between two frequencies.
bool passes_reversal(const Complex& before, const Complex& now) {
  return before.imag() < 0.0 && now.imag() >= 0.0 && now.real() < 0.0;
}

bool passes_one(const Complex& before, const Complex& now) {
  return std::abs(before) >= 1.0 && std::abs(now) < 1.0;
}

/// Takes up what happens between two neighbouring frequencies of the search.
void take_step(const Complex& before, const Complex& now, double w, LoopMargins& margins) {
  if (margins.crossover_Hz == 0.0 && passes_one(before, now)) {
    margins.crossover_Hz = w / kTwoPi;
    // A lag beyond 180 deg has wrapped around to a phase above 0.
    const double phase = std::arg(now) * 360.0 / kTwoPi;
    margins.phase_margin_deg = phase > 0.0 ? phase - 180.0 : phase + 180.0;
  }
  if (margins.gain_margin == 0.0 && passes_reversal(before, now)) {
    margins.gain_margin = 1.0 / std::abs(now);
  }
  if (follows(before) && !follows(now)) {
    margins.bandwidth_Hz = w / kTwoPi;
  }
}

}  // namespace

LoopMargins loop_margins(const motion::Gains& gains, const hal::mujoco::AxisParams& axis,
                         double period) {
  LoopMargins margins;
  margins.phase_margin_deg = 180.0;
  const auto at = [&](double w) { return open_loop(gains, axis, period, w); };
  const double highest = std::numbers::pi / period;
  double w = kLowest;
  Complex before = at(w);
  while (w * kStep < highest) {
    // Strides first; only where something happens within one, its steps.
    std::array<double, kStride> steps{};
    std::size_t count = 0;
    for (double next = w * kStep; count < kStride && next < highest; next *= kStep) {
      steps[count++] = next;
    }
    const Complex far = at(steps[count - 1]);
    if (passes_one(before, far) || passes_reversal(before, far) ||
        follows(before) != follows(far)) {
      for (std::size_t i = 0; i < count; ++i) {
        const Complex now = i + 1 == count ? far : at(steps[i]);
        take_step(before, now, steps[i], margins);
        before = now;
      }
    }
    before = far;
    w = steps[count - 1];
  }
  if (margins.gain_margin == 0.0) {
    margins.gain_margin = INFINITY;
  }
  return margins;
}

}  // namespace twin::config

#include "shadow/hum_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/units.hpp"
#include "shadow/driven_axis.hpp"

namespace twin::shadow {
namespace {

constexpr std::size_t kWindow = 256;   // periods
constexpr double kCorrection = 0.15;   // least part of a window's dP that is taken over
constexpr double kSmallestHum = 1e-4;  // [V]
constexpr double kMeasured = 0.4;      // time over which H is found, after as long a start [s]
constexpr double kDrive = 0.2;         // drive command of that motion [V]

}  // namespace

HumTracker::HumTracker(const hal::mujoco::AxisParams& params, double period, double physics_step,
                       int steps)
    : is_wanted_(params.drive.hum_amplitude >= kSmallestHum &&
                 params.drive.hum_frequency_Hz * period > 0.0 &&
                 params.drive.hum_frequency_Hz * period < 0.4),
      omega_(2.0 * std::numbers::pi * params.drive.hum_frequency_Hz),
      period_(period),
      step_turn_(std::polar(1.0, omega_ * period / steps)),
      volts_(static_cast<std::size_t>(steps), 0.0) {
  if (!is_wanted_) {
    return;
  }
  // H: the model in steady motion, with and without a hum of P = amplitude.
  DrivenAxis with(params, period, physics_step, ScrewModel::kRigid, {});
  DrivenAxis without(params, period, physics_step, ScrewModel::kRigid, {});
  with.begin(0.0, kDrive);
  without.begin(0.0, kDrive);
  phasor_ = params.drive.hum_amplitude;
  const auto start = static_cast<std::size_t>(std::lround(kMeasured / period));
  Complex sum{};
  double weight = 0.0;
  for (std::size_t k = 0; k < 2 * start; ++k) {
    with.advance(0.0, next_period());
    without.advance(0.0, {});
    if (k >= start) {
      const double share = static_cast<double>(k - start) / static_cast<double>(start);
      const double hann = 1.0 - std::cos(2.0 * std::numbers::pi * share);
      sum += hann * units::um_from_mm(with.position() - without.position()) * std::conj(turn_);
      weight += 0.5 * hann;
    }
  }
  response_ = sum / weight / phasor_ * (1.0 - std::conj(std::polar(1.0, omega_ * period)));
  phasor_ = 0.0;
  turn_ = 1.0;
}

std::span<const double> HumTracker::next_period() noexcept {
  for (double& volts : volts_) {
    volts = (phasor_ * turn_).real();
    turn_ *= step_turn_;
  }
  turn_ /= std::abs(turn_);
  return volts_;
}

void HumTracker::begin_window() noexcept {
  sum_ = 0.0;
  weight_ = 0.0;
  taken_ = 0;
}

void HumTracker::take(double residual, bool moves) noexcept {
  const double increment = residual - last_;
  last_ = residual;
  if (!is_wanted_) {
    return;
  }
  if (!moves || !has_last_) {
    has_last_ = true;
    begin_window();
    return;
  }
  const double share = (static_cast<double>(taken_) + 0.5) / static_cast<double>(kWindow);
  const double hann = 1.0 - std::cos(2.0 * std::numbers::pi * share);
  sum_ += hann * increment * std::conj(turn_);
  weight_ += 0.5 * hann;
  if (++taken_ < kWindow) {
    return;
  }
  phasor_ +=
      std::max(1.0 / static_cast<double>(windows_ + 1), kCorrection) * (sum_ / weight_) / response_;
  ++windows_;
  begin_window();
}

}  // namespace twin::shadow

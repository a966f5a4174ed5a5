#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "hal/mujoco/table_params.hpp"

namespace twin::shadow {

/// Finds the mains hum on V-REF in the residual of a model that is driven without it, and then gives
/// it to the model.
///
/// The hum is u(t) = Re(P exp(i w t)) with the frequency of the machine file and a phasor P that
/// nobody knows before the run. Through the drive it moves the axis by Re(H P exp(i w t)), with H
/// found on the model in steady motion. Over windows of motion the increments d of the residual are
/// correlated with it under Hann's weights g,
///   D = sum g_k d_k exp(-i w t_k) / (sum g_k / 2),   dP = D / (H (1 - exp(-i w T))).
/// The first window sets P, the next ones correct it so that it becomes their mean, and then by a
/// part of dP, so that amplitude, phase and a frequency that is a little off are followed.
class HumTracker {
 public:
  /// Allocates. @param steps  physics steps in a period T [s]
  HumTracker(const hal::mujoco::AxisParams& params, double period, double physics_step, int steps);

  /// Whether there is a hum to be found.
  bool is_wanted() const noexcept { return is_wanted_; }
  /// Whether the models have it, or there is none.
  bool is_found() const noexcept { return !is_wanted_ || windows_ > 0; }
  /// The hum in the coming period, step by step [V]. Real-time safe.
  std::span<const double> next_period() noexcept;
  /// Takes the residual of this period [um]. Real-time safe. @param moves  whether the axis does
  void take(double residual, bool moves) noexcept;

 private:
  using Complex = std::complex<double>;
  void begin_window() noexcept;

  bool is_wanted_;
  double omega_;       // [rad/s]
  double period_;      // [s]
  Complex response_;   // H (1 - exp(-i w T)), of increments [um/V]
  Complex phasor_{};   // P [V]
  Complex turn_{1.0};  // exp(i w t) at the begin of the coming period
  Complex step_turn_;  // the same over a physics step
  std::vector<double> volts_;
  Complex sum_{};
  double weight_ = 0.0;
  double last_ = 0.0;        // residual of the last period [um]
  std::size_t taken_ = 0;    // periods of this window
  std::size_t windows_ = 0;  // that are complete
  bool has_last_ = false;
};

}  // namespace twin::shadow

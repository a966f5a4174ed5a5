#pragma once

#include "hal/mujoco/table_params.hpp"
#include "motion/motion_settings.hpp"

namespace twin::config {

/// How far the position loop of an axis is from oscillating, and how fast it follows.
struct LoopMargins {
  double crossover_Hz = 0.0;  ///< where the open loop falls to 1, the first time
  double bandwidth_Hz = 0.0;  ///< where the closed loop falls to -3 dB, the last time
  double phase_margin_deg =
      0.0;                   ///< further phase lag at the crossover that would make it oscillate
  double gain_margin = 0.0;  ///< factor of the gain that would make it oscillate

  bool is_stable() const { return gain_margin > 1.0 && phase_margin_deg > 0.0; }
};

/// Margins of the position loop of an axis, by the linear part of the machine file's model: servo
/// [motion::AxisServo], hold of the period T, delay and filter of V-REF, velocity PI on the total
/// inertia with the lag of the current loop [hal::mujoco::Drive]. With s = j w,
///   L(s) = (Kp + Kd (1 - exp(-s T)) / T) (1 - exp(-s T)) / (s T) exp(-s Td) / (1 + Tf s) V(s) / s
///   V = Lv / (1 + Lv),   Lv(s) = 2 pi f (s + 1/Ti) / (s^2 (1 + Tc s)).
/// Friction and the compliance of the screw are left out. Friction holds a loop that is slightly
/// unstable by this measure in a small oscillation.
///
/// @param period  interpolation period T [s]
LoopMargins loop_margins(const motion::Gains& gains, const hal::mujoco::AxisParams& axis,
                         double period);

}  // namespace twin::config

#pragma once

#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// Friction of one slide: the LuGre bristle with a purely elastic zone.
///
/// With the velocity v, Fc and s2 in the direction of v, the mean bristle deflection z and the Stribeck curve
///   g(v) = Fc + (Fs - Fc) exp(-(v / vs)^2),   Fs = static_ratio Fc,
/// the model is
///   dz/dt = v - alpha s0 |v| z / g(v)
///   F = s0 z + s1 dz/dt + s2 v,
/// where F acts against the motion. In steady sliding z = sgn(v) g / s0 and F = sgn(v) g(v) + s2 v.
///
/// alpha = 1 is LuGre [Canudas de Wit 1995], which creeps under a vibrating load below breakaway.
/// As in the elasto-plastic model [Dupont 2002], with
///   z_ba = elastic_share Fc / s0,   z_ss = g / s0,
/// alpha is 0 while |z| < z_ba or while z and v differ in sign. It is 1 from z_ss on, and rises as
/// half a sine wave in between. So below z_ba the bristle is a spring, which loses no energy.
/// elastic_share = 0 gives plain LuGre.
///
/// The integration over the step h is exact for constant v and alpha:
///   lambda = alpha s0 |v| / g,  E = exp(-lambda h)
///   z' = z E + v (1 - E) / lambda      (z + v h where lambda h < 1e-6)
///   F  = s0 z' + s1 (z' - z) / h + s2 v
/// An explicit Euler step diverges once s0 |v| h / g > 2, which 10 N and 1e4 N/mm reach at 20 mm/s.
/// The new z' enters the force, so that the bristle's spring is integrated semi-implicitly together
/// with the slide.
class Lugre {
 public:
  /// @param step physics step h > 0 [s]
  Lugre(const FrictionParams& params, double step) noexcept;

  /// Advances by one step and returns the friction force, positive against positive motion [N].
  /// Real-time safe. @param velocity of the slide at the start of the step [mm/s]
  double step(double velocity) noexcept;
  /// Relaxes the bristle. Real-time safe.
  void reset() noexcept { deflection_ = 0.0; }
  /// Bends the bristle as in steady sliding. Real-time safe. @param velocity [mm/s]
  void reset(double velocity) noexcept;
  /// Bristle deflection z [mm].
  double deflection() const noexcept { return deflection_; }

  /// Stribeck curve g(v) [N].
  double stribeck(double velocity) const noexcept;

 private:
  double plastic_share(double velocity, double steady) const noexcept;

  FrictionParams params_;
  double step_;              // h [s]
  double breakaway_;         // z_ba [mm]
  double deflection_ = 0.0;  // z [mm]
};

}  // namespace twin::hal::mujoco

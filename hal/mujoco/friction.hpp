#pragma once

#include <array>
#include <variant>

#include "hal/mujoco/lugre.hpp"
#include "hal/mujoco/table_params.hpp"

namespace twin::hal::mujoco {

/// Plain Coulomb and viscous friction: a spring of stiffness s0 that slips at Fc.
///   z' = clamp(z + v h, -Fc / s0, Fc / s0),   F = s0 z' + s2 v
/// In steady sliding F = sgn(v) Fc + s2 v. At rest the spring holds any load below Fc without
/// creeping.
class CoulombFriction {
 public:
  CoulombFriction(const FrictionParams& params, double step) noexcept
      : params_(params), step_(step) {}
  /// Advances by one step and returns the friction force [N]. Real-time safe.
  double step(double velocity) noexcept;
  /// The spring's force becomes that of sliding with a velocity [mm/s]; 0 relaxes it.
  void reset(double velocity) noexcept;

 private:
  FrictionParams params_;
  double step_;         // h [s]
  double force_ = 0.0;  // of the spring [N]
};

/// Friction of generalised Maxwell slip [Lampaert, Al-Bender, Swevers 2003]: n = 4 springs side by
/// side, each of which sticks until it reaches its share of the Stribeck curve g(v) and then slips.
///   sticks:  dF_i/dt = k_i v                             until |F_i| = g(v) / n
///   slips:   dF_i/dt = sgn(v) C (1 / n - F_i / g(v)),    C = s0 vs, until v changes its sign
///   F = sum F_i + s2 v
/// The stiffnesses are k_i = s0 (1/i) / (1 + 1/2 + 1/3 + 1/4), so that a slow start from rest goes
/// along a line of five pieces, and a reversal along the same line doubled (Masing's rule): F
/// depends on where the motion turned, which one bristle forgets.
class MaxwellFriction {
 public:
  static constexpr int kElements = 4;  ///< n

  MaxwellFriction(const FrictionParams& params, double step) noexcept;
  /// Advances by one step and returns the friction force [N]. Real-time safe.
  double step(double velocity) noexcept;
  /// The springs' forces become those of sliding with a velocity [mm/s]; 0 relaxes them.
  void reset(double velocity) noexcept;

 private:
  double stribeck(double velocity) const noexcept;

  FrictionParams params_;
  double step_;                            // h [s]
  std::array<double, kElements> force_{};  // F_i [N]
  std::array<bool, kElements> slips_{};
  double last_velocity_ = 0.0;  // [mm/s]
};

/// Friction of one slide by the law that its parameters name.
class Friction {
 public:
  /// @param step physics step h > 0 [s]
  Friction(const FrictionParams& params, double step) noexcept;

  /// Advances by one step and returns the friction force, positive against positive motion [N].
  /// Real-time safe. @param velocity of the slide at the start of the step [mm/s]
  double step(double velocity) noexcept {
    if (Lugre* const lugre = std::get_if<Lugre>(&law_)) {
      return lugre->step(velocity);
    }
    return step_other(velocity);
  }
  /// Steady sliding with a velocity [mm/s] becomes the past; 0: relaxed. Real-time safe.
  void reset(double velocity) noexcept;

 private:
  double step_other(double velocity) noexcept;

  std::variant<Lugre, CoulombFriction, MaxwellFriction> law_;
};

}  // namespace twin::hal::mujoco

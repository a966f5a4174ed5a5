#include "hal/mujoco/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::hal::mujoco {
namespace friction_test {

constexpr double kStep = 1e-5;  // [s]

FrictionParams params_of(FrictionLaw law) {
  FrictionParams params;
  params.law = law;
  params.coulomb = 20.0;
  params.static_ratio = 1.5;
  params.stribeck_velocity = 2.0;
  params.bristle_stiffness = 2e4;
  params.bristle_damping = 0.0;
  params.viscous = 0.2;
  return params;
}

/// Force after a long way with a constant velocity [N].
double sliding_force(const FrictionParams& params, double velocity) {
  Friction friction(params, kStep);
  double force = 0.0;
  const double way = 0.2;  // far more than any spring bends [mm]
  for (int i = 0; i * kStep * std::abs(velocity) < way; ++i) {
    force = friction.step(velocity);
  }
  return force;
}

/// Fc + (Fs - Fc) exp(-(v / vs)^2), in the direction of v, and viscous friction.
double closed_form(const FrictionParams& p, double v) {
  const double side = v > 0.0 ? 1.0 : -1.0;
  const double coulomb = p.coulomb + side * p.coulomb_asymmetry;
  const double ratio = p.law == FrictionLaw::kCoulomb ? 1.0 : p.static_ratio;
  const double bend = std::exp(-std::pow(v / p.stribeck_velocity, 2));
  return side * coulomb * (1.0 + (ratio - 1.0) * bend) +
         (p.viscous + side * p.viscous_asymmetry) * v;
}

TEST(Friction, SteadySlidingIsItsClosedFormUnderEveryLawAndEitherWay) {
  for (const FrictionLaw law :
       {FrictionLaw::kLugre, FrictionLaw::kCoulomb, FrictionLaw::kMaxwell}) {
    for (const double asymmetry : {0.0, 0.3}) {
      FrictionParams params = params_of(law);
      params.coulomb_asymmetry = asymmetry * params.coulomb;
      params.viscous_asymmetry = -asymmetry * params.viscous;
      for (const double velocity : {-100.0, -5.0, -1.0, 0.5, 2.0, 50.0}) {
        const double expected = closed_form(params, velocity);
        EXPECT_NEAR(sliding_force(params, velocity), expected, 2e-3 * std::abs(expected))
            << static_cast<int>(law) << " at " << velocity << " mm/s";
      }
    }
  }
}

TEST(Friction, CoulombsSpringHoldsBelowFcAndSlipsThere) {
  const FrictionParams params = params_of(FrictionLaw::kCoulomb);
  CoulombFriction friction(params, kStep);
  const double velocity = 0.01;
  for (int i = 1; i <= 20000; ++i) {
    const double bent = params.bristle_stiffness * velocity * kStep * i;
    EXPECT_NEAR(friction.step(velocity) - params.viscous * velocity, std::min(bent, params.coulomb),
                1e-6);
  }
}

/// Force of the springs side by side that were bent slowly by a way from rest [N].
double virgin_curve(const FrictionParams& p, double way) {
  double force = 0.0;
  const double limit = p.static_ratio * p.coulomb / MaxwellFriction::kElements;
  for (int i = 1; i <= MaxwellFriction::kElements; ++i) {
    const double stiffness = p.bristle_stiffness / (25.0 / 12.0) / i;
    force += std::min(stiffness * way, limit);
  }
  return force;
}

TEST(Friction, MaxwellSlipFollowsItsVirginCurveAndMasingsRuleAtAReversal) {
  FrictionParams params = params_of(FrictionLaw::kMaxwell);
  params.viscous = 0.0;
  params.static_ratio = 1.0;  // so that nothing but the way counts
  MaxwellFriction friction(params, kStep);
  const double velocity = 0.02;
  const int steps = 6000;  // 1.2 um: half of the springs slip
  double turned = 0.0;
  for (int i = 1; i <= steps; ++i) {
    turned = friction.step(velocity);
    ASSERT_NEAR(turned, virgin_curve(params, velocity * kStep * i), 0.01 * params.coulomb);
  }
  for (int i = 1; i <= 2 * steps; ++i) {
    const double expected = turned - 2.0 * virgin_curve(params, velocity * kStep * i / 2.0);
    ASSERT_NEAR(friction.step(-velocity), expected, 0.02 * params.coulomb) << i;
  }
}

TEST(Friction, ResetMakesSlidingThePast) {
  for (const FrictionLaw law :
       {FrictionLaw::kLugre, FrictionLaw::kCoulomb, FrictionLaw::kMaxwell}) {
    const FrictionParams params = params_of(law);
    Friction friction(params, kStep);
    for (const double velocity : {30.0, -30.0}) {
      friction.reset(velocity);
      const double expected = closed_form(params, velocity);
      EXPECT_NEAR(friction.step(velocity), expected, 2e-3 * std::abs(expected));
    }
  }
}

}  // namespace friction_test
}  // namespace twin::hal::mujoco

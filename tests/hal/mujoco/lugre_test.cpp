#include "hal/mujoco/lugre.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::hal::mujoco {
namespace lugre_test {

constexpr double kStep = 1e-4;  // [s]

/// Bristles of both axes, with and without the elastic zone.
std::vector<FrictionParams> all_params() {
  std::vector<FrictionParams> list;
  for (const AxisParams& axis : TableParams{}.axis) {
    for (const double share : {0.0, 0.5, 0.9}) {
      list.push_back(axis.friction);
      list.back().elastic_share = share;
    }
  }
  return list;
}

/// Stribeck formula, written out once more [N].
double stribeck_curve(const FrictionParams& p, double v) {
  const double fs = p.static_ratio * p.coulomb;
  const double shape = std::exp(-(v * v) / (p.stribeck_velocity * p.stribeck_velocity));
  return std::copysign(p.coulomb + (fs - p.coulomb) * shape, v) + p.viscous * v;
}

TEST(Lugre, SteadyFrictionFollowsTheStribeckCurveWithinOnePercent) {
  for (const FrictionParams& params : all_params()) {
    for (const double speed : {0.05, 0.5, 1.0, 2.0, 4.0, 10.0, 50.0, 200.0}) {
      for (const double v : {speed, -speed}) {
        Lugre friction(params, kStep);
        double force = 0.0;
        for (double travel = 0.0; travel < 1.0; travel += speed * kStep) {
          force = friction.step(v);
        }
        EXPECT_NEAR(force / stribeck_curve(params, v), 1.0, 0.01) << v << " mm/s";
      }
    }
  }
}

TEST(Lugre, StaysFiniteAndBoundedWhereAnExplicitBristleDiverges) {
  FrictionParams params;
  params.coulomb = 20.0;
  params.bristle_stiffness = 30e3;  // explicit Euler diverges above 13 mm/s
  params.bristle_damping = 0.0;
  Lugre friction(params, kStep);
  for (int k = 0; k < 20000; ++k) {
    const double v = 200.0 * std::sin(0.05 * k);
    const double force = friction.step(v) - params.viscous * v;
    ASSERT_LE(std::abs(force), params.coulomb * params.static_ratio * (1.0 + 1e-9));
  }
}

TEST(Lugre, PreSlidingStiffnessIsThatOfTheBristle) {
  for (FrictionParams params : all_params()) {
    params.bristle_damping = 0.0;
    params.viscous = 0.0;
    Lugre friction(params, kStep);
    const double full = params.coulomb / params.bristle_stiffness;  // [mm]
    const double goal = 0.02 * full;
    double force = 0.0;
    for (int k = 0; k < 100; ++k) {
      force = friction.step(goal / 100.0 / kStep);
    }
    EXPECT_NEAR(force / goal, params.bristle_stiffness, 0.02 * params.bristle_stiffness);
  }
}

TEST(Lugre, ElasticZoneGivesBackTheWorkPutIn) {
  FrictionParams params;
  params.bristle_damping = 0.0;
  params.viscous = 0.0;
  params.elastic_share = 0.9;
  Lugre friction(params, kStep);
  const double reach = 0.85 * params.coulomb / params.bristle_stiffness;
  const int n = 2000;
  double force = 0.0;
  for (int k = 0; k < n; ++k) {
    force = friction.step(reach / n / kStep);
  }
  EXPECT_NEAR(force, 0.85 * params.coulomb, 1e-6);
  for (int k = 0; k < n; ++k) {
    force = friction.step(-reach / n / kStep);
  }
  EXPECT_NEAR(force, 0.0, 1e-6);
}

// A block of 10 kg pulled ever harder lets go at Fs: it has moved no more than the bristle's reach
// before.
TEST(Lugre, BreaksAwayAtStaticFriction) {
  for (const FrictionParams& params : all_params()) {
    const double breakaway = params.coulomb * params.static_ratio;
    const double mass = 0.01;  // 10 kg in N s^2/mm
    Lugre friction(params, kStep);
    double v = 0.0;
    double pull = 0.0;
    while (v < params.stribeck_velocity && pull < 2.0 * breakaway) {
      pull += 2.0 * kStep;  // 2 N/s
      v += kStep * (pull - friction.step(v)) / mass;
    }
    EXPECT_NEAR(pull, breakaway, 0.03 * breakaway) << "s0 " << params.bristle_stiffness;
  }
}

TEST(Lugre, WithoutCoulombFrictionOnlyTheViscousPartIsLeft) {
  FrictionParams params;
  params.coulomb = 0.0;
  Lugre friction(params, kStep);
  EXPECT_DOUBLE_EQ(friction.step(30.0), params.viscous * 30.0);
}

}  // namespace lugre_test
}  // namespace twin::hal::mujoco

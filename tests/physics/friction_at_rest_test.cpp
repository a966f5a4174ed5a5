#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/table_files.hpp"

// Friction of the whole table at rest and about to move, servo off: MuJoCo's slide and the bristle
// together.
namespace twin::hal::mujoco {
namespace friction_at_rest_test {

constexpr double kPeriod = 1e-3;  // [s]

double breakaway(const AxisParams& axis) {
  return axis.friction.coulomb * axis.friction.static_ratio;
}

class PushedTable : public ::testing::TestWithParam<Axis> {
 protected:
  TableParams params = test::default_table();
  MujocoMachine machine{params};
  Axis axis = GetParam();
  double held = breakaway(params.axis[GetParam()]);  // breakaway force [N]

  void SetUp() override { ASSERT_TRUE(checked(machine.configure(kPeriod))); }

  void pass(double seconds, double force) {
    Inputs inputs;
    machine.set_external_force(axis, force);
    for (int k = 0; k < std::lround(seconds / kPeriod); ++k) {
      ASSERT_EQ(machine.read(inputs), Status::kOk);
    }
  }
  double position() const { return machine.truth().table_position[axis]; }
};

TEST_P(PushedTable, DoesNotCreepAtHalfTheBreakawayForce) {
  pass(1.0, 0.5 * held);
  const double before = position();
  pass(10.0, 0.5 * held);
  EXPECT_LT(std::abs(position() - before), 0.1e-3);
}

TEST_P(PushedTable, DoesNotCreepUnderAVibratingLoad) {
  // 50 Hz in whole periods of 20 ms, always back at the mean load when the position is compared.
  const auto vibrate = [this](double seconds) {
    for (int k = 0; k < std::lround(seconds / kPeriod); ++k) {
      pass(kPeriod, held * (0.4 + 0.15 * std::sin(2.0 * std::numbers::pi * k / 20.0)));
    }
  };
  vibrate(2.0);
  const double before = position();
  vibrate(10.0);
  EXPECT_LT(std::abs(position() - before), 0.1e-3);
}

// A force that grows slowly, so that damping and inertia add nothing to it. Up to the elastic share
// of the Coulomb friction the slide hangs on the bristle as on a spring.
TEST_P(PushedTable, PreSlidingStiffnessIsThatOfTheBristleWithinOnePercent) {
  const FrictionParams& friction = params.axis[axis].friction;
  const double rate = 2.0;  // [N/s]
  std::array<double, 2> force{};
  std::array<double, 2> place{};
  double pull = 0.0;
  for (const std::size_t i : {0U, 1U}) {
    force[i] = (i == 0 ? 0.2 : 0.8) * friction.coulomb;
    for (; pull < force[i]; pull += rate * kPeriod) {
      pass(kPeriod, pull);
    }
    place[i] = position();
  }
  const double stiffness = (force[1] - force[0]) / (place[1] - place[0]);
  EXPECT_NEAR(stiffness, friction.bristle_stiffness, 0.01 * friction.bristle_stiffness);
}

TEST_P(PushedTable, BreaksAwayAtStaticFrictionWithinTwoPercent) {
  const double rate = 1.0;  // [N/s]
  double pull = 0.0;
  while (machine.velocity(axis) < 0.1 * params.axis[axis].friction.stribeck_velocity &&
         pull < 1.5 * held) {
    pull += rate * kPeriod;
    pass(kPeriod, pull);
  }
  EXPECT_NEAR(pull, held, 0.02 * held);
}

TEST_P(PushedTable, DeflectsElasticallyByForceOverBristleStiffness) {
  const FrictionParams& friction = params.axis[axis].friction;
  const double force = 0.5 * friction.coulomb;
  pass(3.0, force);
  EXPECT_NEAR(position(), force / friction.bristle_stiffness,
              0.01 * force / friction.bristle_stiffness);
  pass(3.0, 0.0);
  EXPECT_NEAR(position(), 0.0, 0.01 * force / friction.bristle_stiffness);
}

TEST_P(PushedTable, TerminalSpeedIsWhereFrictionBalancesThePush) {
  // At 50 mm/s the Stribeck part has died out: force = Fc + s2 v.
  const FrictionParams& friction = params.axis[axis].friction;
  TableParams slippery = params;
  slippery.axis[axis].friction.viscous = 1.0;  // N s/mm, so that it settles soon
  MujocoMachine sliding(slippery);
  ASSERT_TRUE(checked(sliding.configure(kPeriod)));
  sliding.set_external_force(axis, friction.coulomb + 50.0);
  Inputs inputs;
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(sliding.read(inputs), Status::kOk);
  }
  EXPECT_NEAR(sliding.velocity(axis), 50.0, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Axes, PushedTable, ::testing::Values(kX, kY),
                         [](const ::testing::TestParamInfo<Axis>& tested) {
                           return tested.param == kX ? "X" : "Y";
                         });

}  // namespace friction_at_rest_test
}  // namespace twin::hal::mujoco

#include "studies/identify/inverse_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "simulated_recording.hpp"

namespace twin::studies::identify {
namespace inverse_model_test {

config::MachineFile plain_machine() {
  config::MachineFile machine;
  hal::mujoco::AxisParams& x = machine.table.axis[hal::kX];
  x.encoder.mm_per_count = 1e-4;
  x.friction.law = hal::mujoco::FrictionLaw::kCoulomb;
  x.friction.viscous = 0.2;
  x.friction.bristle_stiffness = 2e4;
  x.load.weight = -35.0;
  x.drive.hum_amplitude = 0.0;
  return machine;
}

AxisRecord record_of(const config::MachineFile& machine) {
  return axis_record(record_x(machine, Recorded::kVoltsAndForce, 6.0), hal::kX, machine);
}

TEST(InverseModel, FindsMassFrictionAndWeightOfASimulatedAxis) {
  const config::MachineFile machine = plain_machine();
  const hal::mujoco::AxisParams& x = machine.table.axis[hal::kX];
  const AxisRecord record = record_of(machine);
  const InverseModel model = fit_inverse_model({&record, 1}, 1e-3, 1e-4, Directions::kAlike);
  EXPECT_NEAR(model.mass.value, x.moving_mass + x.rotor_mass(), 0.01 * x.moving_mass);
  EXPECT_NEAR(model.viscous.value, x.friction.viscous, 0.03 * x.friction.viscous);
  EXPECT_NEAR(model.coulomb.value, x.friction.coulomb, 0.03 * x.friction.coulomb);
  EXPECT_NEAR(model.weight.value, x.load.weight, 0.01 * std::abs(x.load.weight));
  EXPECT_TRUE(model.has_both_directions);
}

TEST(InverseModel, FrictionThatDiffersEitherWayIsToldAndFitted) {
  config::MachineFile machine = plain_machine();
  hal::mujoco::FrictionParams& friction = machine.table.axis[hal::kX].friction;
  friction.viscous_asymmetry = 0.1;
  const AxisRecord record = record_of(machine);
  const InverseModel alike = fit_inverse_model({&record, 1}, 1e-3, 1e-4, Directions::kAlike);
  const InverseModel two_way = fit_inverse_model({&record, 1}, 1e-3, 1e-4, Directions::kTwoWay);
  EXPECT_NEAR(two_way.viscous_asymmetry.value, 0.1, 0.01);
  EXPECT_LT(two_way.relative_error, 0.7 * alike.relative_error);
  ASSERT_FALSE(alike.seems_to_lack.empty());
  EXPECT_NE(alike.seems_to_lack.front().find("either way"), std::string::npos);
  EXPECT_NEAR(alike.weight.value, machine.table.axis[hal::kX].load.weight,
              2.0 * alike.weight.sigma);
}

TEST(InverseModel, OneDirectionDoesNotTellWeightFromFriction) {
  const config::MachineFile machine = plain_machine();
  Recording recording = record_x(machine, Recorded::kVoltsAndForce, 6.0);
  AxisSignals& x = recording.axis[hal::kX];
  for (std::size_t k = 0; k < x.command.size(); ++k) {  // away and away
    x.command[k] = 10.0 * static_cast<double>(k) * 1e-3;
    x.measured[k] = x.command[k] + 2.0 * std::sin(3e-3 * static_cast<double>(k));
    x.force[k] = 5.0;
  }
  const AxisRecord record = axis_record(recording, hal::kX, machine);
  const InverseModel model = fit_inverse_model({&record, 1}, 1e-3, 1e-4, Directions::kTwoWay);
  EXPECT_FALSE(model.has_both_directions);
  EXPECT_FALSE(model.is_two_way);
  EXPECT_EQ(model.weight.value, 0.0);
}

}  // namespace inverse_model_test
}  // namespace twin::studies::identify

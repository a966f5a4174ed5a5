#include "hal/mujoco/mujoco_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/position_loop.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::mujoco {
namespace mujoco_machine_test {

using test::default_table;

constexpr double kPeriod = 1e-3;  // [s]

/// Lets periods pass with the outputs as they are.
void pass(MujocoMachine& machine, const Outputs& outputs, int periods, Inputs& inputs) {
  for (int k = 0; k < periods; ++k) {
    ASSERT_EQ(machine.write(outputs), Status::kOk);
    ASSERT_EQ(machine.read(inputs), Status::kOk) << machine.last_error();
  }
}

Outputs volts(double x, double y) {
  Outputs outputs;
  outputs.servo_on = {true, true};
  outputs.volts = {x, y};
  return outputs;
}

TEST(MujocoMachine, OneVoltIsTheScaledSpeedOnBothAxes) {
  TableParams params = default_table();
  MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  pass(machine, volts(0.6, -0.3), 1000, inputs);
  EXPECT_NEAR(machine.info().mm_per_s_per_volt[kX], 500.0 / 60.0 * 10.0, 1e-9);
  const double hum = 0.02 * machine.info().mm_per_s_per_volt[kX];
  EXPECT_NEAR(machine.velocity(kX), 50.0, hum * 1.3);
  EXPECT_NEAR(machine.velocity(kY), -25.0, hum * 1.3);
}

TEST(MujocoMachine, ReversedScalesReverseBothTheWireAndTheCount) {
  TableParams params = default_table();
  params.axis[kX].drive.vref_scale_rpm_per_V = -500.0;
  params.axis[kY].encoder.mm_per_count = -0.010;
  MujocoMachine machine(params);
  const auto rows = test::run_loop(machine, test::default_gains(), kPeriod, 0.5, [](double t) {
    return test::on_circle(10.0, test::smooth_start(t, 20.0, 0.1));
  });
  EXPECT_LT(
      test::spread(rows, 0, [](const test::Row& r) { return test::circle_error(r, 10.0); }).max,
      0.04);
}

TEST(MujocoMachine, OutputsArriveAfterTheOutputDelay) {
  TableParams params = test::faultless_table();
  params.axis[kX].drive.output_delay = 3e-3;
  params.axis[kX].drive.ready_delay = 0.0;
  MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  pass(machine, volts(1.0, 0.0), 3, inputs);
  EXPECT_EQ(machine.velocity(kX), 0.0);
  pass(machine, volts(1.0, 0.0), 1, inputs);
  EXPECT_GT(machine.velocity(kX), 10.0);
}

TEST(MujocoMachine, RunsIntoItsSwitchStopsAndComesBack) {
  TableParams params = default_table();
  params.axis[kX].travel = 20.0;
  MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  pass(machine, volts(1.0, 0.0), 600, inputs);
  EXPECT_TRUE(inputs.limit_positive[kX]);
  EXPECT_FALSE(inputs.limit_negative[kX] || inputs.limit_positive[kY]);
  EXPECT_FALSE(inputs.alarm[kX]);
  EXPECT_NEAR(machine.truth().table_position[kX], 20.0, 4.0);
  pass(machine, volts(-0.5, 0.0), 300, inputs);
  EXPECT_FALSE(inputs.limit_positive[kX]);
  pass(machine, volts(-0.5, 0.0), 900, inputs);
  EXPECT_TRUE(inputs.limit_negative[kX]);
}

TEST(MujocoMachine, BlockedAxisRaisesAnAlarmAndActivationClearsIt) {
  MujocoMachine machine(default_table());
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  machine.set_external_force(kY, 2000.0);
  pass(machine, volts(0.0, -2.0), 1000, inputs);
  EXPECT_TRUE(inputs.alarm[kY]);
  EXPECT_FALSE(inputs.alarm[kX]);
  EXPECT_FALSE(inputs.servo_ready[kY]);
  machine.set_external_force(kY, 0.0);
  machine.deactivate();
  ASSERT_TRUE(checked(machine.activate()));
  pass(machine, volts(0.0, 0.0), 100, inputs);
  EXPECT_FALSE(inputs.alarm[kY]);
  EXPECT_TRUE(inputs.servo_ready[kY]);
}

TEST(MujocoMachine, CountsAndTruthStartAgainWhereItIsActivated) {
  MujocoMachine machine(default_table());
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  pass(machine, volts(0.5, 0.5), 300, inputs);
  pass(machine, volts(0.0, 0.0), 300, inputs);
  EXPECT_GT(inputs.counts[kX], 500);
  machine.deactivate();
  ASSERT_TRUE(checked(machine.activate()));
  EXPECT_EQ(machine.truth().table_position[kX], 0.0);
  pass(machine, volts(0.0, 0.0), 1, inputs);
  EXPECT_EQ(inputs.counts[kX], 0);
}

TEST(MujocoMachine, DeactivatedTableCoastsToRestOnItsFriction) {
  MujocoMachine machine(default_table());
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  pass(machine, volts(0.6, 0.6), 500, inputs);
  machine.deactivate();
  for (int k = 0; k < 1000; ++k) {
    ASSERT_EQ(machine.read(inputs), Status::kOk);
  }
  EXPECT_NEAR(machine.velocity(kX), 0.0, 1e-3);
  EXPECT_NEAR(machine.velocity(kY), 0.0, 1e-3);
  EXPECT_FALSE(inputs.servo_ready[kX]);
}

TEST(MujocoMachine, PenFollowsItsReferenceWithoutOvershoot) {
  MujocoMachine machine(default_table());
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Outputs outputs = volts(0.0, 0.0);
  outputs.position_reference[2] = 15.0;
  Inputs inputs;
  double highest = 0.0;
  for (int k = 0; k < 300; ++k) {
    pass(machine, outputs, 1, inputs);
    highest = std::max(highest, machine.pen_position());
  }
  EXPECT_NEAR(machine.pen_position(), 15.0, 1e-3);
  EXPECT_LT(highest, 15.001);
}

TEST(MujocoMachine, UnstablePhysicsIsAnErrorWithTheTimeAndWhatToDo) {
  TableParams params = default_table();
  params.model = test::mjcf_file("xy_table_compliant.xml");
  params.physics_step = 1e-3;  // far too coarse for the screw's resonance
  params.axis[kX].screw.stiffness = 1e6;
  params.axis[kX].drive.velocity_gain_Hz = 100.0;
  MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Inputs inputs;
  Status status = Status::kOk;
  for (int k = 0; k < 5000 && status == Status::kOk; ++k) {
    machine.write(volts(1.0, 0.0));
    status = machine.read(inputs);
  }
  ASSERT_EQ(status, Status::kError);
  EXPECT_EQ(machine.state(), State::kInactive);
  EXPECT_THAT(machine.last_error(), ::testing::HasSubstr("unstable"));
  EXPECT_THAT(machine.last_error(), ::testing::HasSubstr("table.physics_step_ms"));
  EXPECT_FALSE(checked(machine.activate())) << "must be configured again";
  EXPECT_FALSE(checked(machine.configure(1e-3)) && machine.read(inputs) != Status::kOk);
}

TEST(MujocoMachine, SaddleLighterThanWhatItCarriesIsRefused) {
  TableParams params = default_table();
  params.axis[kY].moving_mass = 10.0;
  MujocoMachine machine(params);
  const auto result = checked(machine.configure(kPeriod));
  ASSERT_FALSE(result);
  EXPECT_THAT(result.error().message, ::testing::HasSubstr("table.y.moving_mass_kg"));
}

// A push of known force on the free, frictionless slide shows the mass that MuJoCo really moves.
TEST(MujocoMachine, SlidesHaveTheMassOfTheParametersWithTheRotor) {
  for (const char* model : {"xy_table.xml", "xy_table_compliant.xml"}) {
    TableParams params = test::faultless_table();
    params.model = test::mjcf_file(model);
    params.axis[kX].moving_mass = 7.0;
    params.axis[kY].moving_mass = 26.0;
    MujocoMachine machine(params);
    ASSERT_TRUE(checked(machine.configure(kPeriod)));
    Inputs inputs;
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      machine.set_external_force(static_cast<Axis>(axis), 10.0);
    }
    for (int k = 0; k < 100; ++k) {
      ASSERT_EQ(machine.read(inputs), Status::kOk);
    }
    for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
      const double rotor = 1.06e-5 * std::pow(2.0 * std::numbers::pi / 0.010, 2);
      const double expected = 1e3 * 10.0 / (params.axis[axis].moving_mass + rotor) * 0.1;
      EXPECT_NEAR(machine.velocity(static_cast<Axis>(axis)), expected, 0.01 * expected) << model;
    }
  }
}

}  // namespace mujoco_machine_test
}  // namespace twin::hal::mujoco

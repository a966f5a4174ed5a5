#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/emulated_machine.hpp"
#include "tests/support/position_loop.hpp"
#include "tests/support/table_files.hpp"

// What every machine must do, whatever is behind its wires.
namespace twin::hal {
namespace contract_test {

using test::default_gains;
using test::mjcf_file;
using test::PlanePoint;

constexpr double kPeriod = 1e-3;  // [s]

struct Kind {
  const char* name;
  std::function<std::unique_ptr<Machine>()> make;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

std::unique_ptr<Machine> make_mujoco(const char* model) {
  mujoco::TableParams params;
  params.model = mjcf_file(model);
  return std::make_unique<mujoco::MujocoMachine>(params);
}

std::unique_ptr<Machine> make_rig() {
  const mujoco::TableParams table = test::default_table();
  const rig::RigSettings settings;
  return test::make_emulated(table, std::make_shared<rig::emulator::EmulatedRig>(table, settings),
                             settings);
}

class MachineContract : public ::testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Machine> machine = GetParam().make();
  Inputs inputs;
  Outputs outputs;

  void start() {
    ASSERT_TRUE(checked(machine->configure(kPeriod)));
    ASSERT_TRUE(checked(machine->activate()));
    outputs.servo_on = {true, true};
  }
};

TEST_P(MachineContract, NamesItselfAndItsScales) {
  EXPECT_FALSE(machine->info().name.empty());
  EXPECT_TRUE(machine->info().simulated);
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    EXPECT_NE(machine->info().mm_per_count[axis], 0.0);
    EXPECT_NE(machine->info().mm_per_s_per_volt[axis], 0.0);
  }
}

TEST_P(MachineContract, RefusesToBeUsedBeforeItIsConfigured) {
  EXPECT_FALSE(checked(machine->activate()));
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_FALSE(machine->last_error().empty());
  EXPECT_EQ(machine->write(outputs), Status::kError);
  machine->deactivate();
  machine->cleanup();
  EXPECT_TRUE(checked(machine->configure(kPeriod)));
  EXPECT_TRUE(machine->last_error().empty());
}

TEST_P(MachineContract, RefusesPeriodsThatAreNone) {
  for (const double period : {0.0, -1e-3, std::numeric_limits<double>::quiet_NaN()}) {
    const Expected<void> result = checked(machine->configure(period));
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kMachine);
  }
}

TEST_P(MachineContract, RefusesOutputsWhileInactive) {
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  EXPECT_EQ(machine->write(outputs), Status::kError);
  EXPECT_FALSE(machine->last_error().empty());
  EXPECT_TRUE(checked(machine->activate()));
  EXPECT_EQ(machine->write(outputs), Status::kOk);
}

TEST_P(MachineContract, ActivatesOnceAtATime) {
  start();
  EXPECT_FALSE(checked(machine->activate()));
  EXPECT_FALSE(checked(machine->configure(kPeriod)));
  machine->deactivate();
  machine->deactivate();
  EXPECT_TRUE(checked(machine->activate()));
}

TEST_P(MachineContract, ActivationIsZeroCounts) {
  start();
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    EXPECT_EQ(inputs.counts[axis], 0);
    EXPECT_FALSE(inputs.alarm[axis]);
    EXPECT_FALSE(inputs.limit_positive[axis]);
    EXPECT_FALSE(inputs.limit_negative[axis]);
    EXPECT_NEAR(machine->truth().table_position[axis], 0.0, 1e-9);
  }
}

TEST_P(MachineContract, IsReadySoonAfterServoOnAndNotBefore) {
  start();
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  EXPECT_FALSE(inputs.servo_ready[kX] || inputs.servo_ready[kY]);
  for (int k = 0; k < 100; ++k) {
    ASSERT_EQ(machine->write(outputs), Status::kOk);
    ASSERT_EQ(machine->read(inputs), Status::kOk);
  }
  EXPECT_TRUE(inputs.servo_ready[kX] && inputs.servo_ready[kY]);
}

TEST_P(MachineContract, GoesWhereTheLoopSendsIt) {
  const auto rows = test::run_loop(*machine, default_gains(), kPeriod, 1.0, [](double t) {
    const auto s = test::smooth_start(std::min(t, 0.5), 20.0, 0.2);
    PlanePoint point;
    point.position[0] = s.value;
    point.position[1] = -0.5 * s.value;
    point.velocity[0] = t < 0.5 ? s.rate : 0.0;
    point.velocity[1] = -0.5 * point.velocity[0];
    return point;
  });
  const double goal = 20.0 * (0.5 - 0.1);
  EXPECT_NEAR(rows.back().encoder[0], goal, 0.03);
  EXPECT_NEAR(rows.back().encoder[1], -0.5 * goal, 0.03);
  EXPECT_NEAR(rows.back().table[0], goal, 0.03);
  EXPECT_NEAR(rows.back().table[1], -0.5 * goal, 0.03);
}

TEST_P(MachineContract, NotANumberStopsItAndActivationRecoversIt) {
  start();
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  outputs.volts[kY] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(machine->write(outputs), Status::kError);
  EXPECT_FALSE(machine->last_error().empty());
  outputs.volts[kY] = 0.0;
  EXPECT_EQ(machine->write(outputs), Status::kError) << "a stopped machine is inactive";
  ASSERT_TRUE(checked(machine->activate()));
  EXPECT_TRUE(machine->last_error().empty());
  EXPECT_EQ(machine->read(inputs), Status::kOk);
}

TEST_P(MachineContract, CleanupForgetsWhereItWas) {
  const auto there = [](double t) {
    PlanePoint point;
    point.position[0] = test::smooth_start(t, 10.0, 0.1).value;
    return point;
  };
  const auto first = test::run_loop(*machine, default_gains(), kPeriod, 0.3, there);
  machine->cleanup();
  const auto second = test::run_loop(*machine, default_gains(), kPeriod, 0.3, there);
  EXPECT_EQ(first, second);
}

TEST_P(MachineContract, TwoMachinesInOneProcessDoNotDisturbEachOther) {
  const auto there = [](double t) {
    return test::on_circle(5.0, test::smooth_start(t, 30.0, 0.1));
  };
  const auto alone = test::run_loop(*machine, default_gains(), kPeriod, 0.3, there);
  const std::unique_ptr<Machine> other = GetParam().make();
  ASSERT_TRUE(checked(other->configure(kPeriod)));
  machine->cleanup();
  const auto beside = test::run_loop(*machine, default_gains(), kPeriod, 0.3, [&](double t) {
    EXPECT_EQ(other->read(inputs), Status::kOk);
    return there(t);
  });
  EXPECT_EQ(alone, beside);
}

TEST_P(MachineContract, ReadAndWriteAllocateNothing) {
  start();
  const std::int64_t before = test::allocations();
  int failures = 0;
  for (int k = 0; k < 200; ++k) {
    failures += machine->read(inputs) != Status::kOk;
    outputs.volts = {0.1 * std::sin(0.1 * k), -0.05};
    failures += machine->write(outputs) != Status::kOk;
    failures += !std::isfinite(machine->truth().table_position[kX]);
  }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_EQ(failures, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Machines, MachineContract,
    ::testing::Values(Kind{"Ideal", [] { return std::make_unique<ideal::IdealMachine>(); }},
                      Kind{"Mujoco", [] { return make_mujoco("xy_table.xml"); }},
                      Kind{"MujocoCompliant", [] { return make_mujoco("xy_table_compliant.xml"); }},
                      Kind{"EmulatedRig", make_rig}),
    [](const ::testing::TestParamInfo<Kind>& kind) { return kind.param.name; });

TEST(IdealMachine, TruthIsTheReferenceOfTheSamePeriod) {
  ideal::IdealMachine machine;
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Outputs outputs;
  Inputs inputs;
  for (int k = 1; k < 10; ++k) {
    outputs.position_reference = {0.37 * k, -1.13 * k, 0.0};
    ASSERT_EQ(machine.write(outputs), Status::kOk);
    EXPECT_EQ(machine.truth().table_position[kX], 0.37 * k);
    EXPECT_EQ(machine.truth().table_position[kY], -1.13 * k);
    ASSERT_EQ(machine.read(inputs), Status::kOk);
    EXPECT_NEAR(static_cast<double>(inputs.counts[kX]) * machine.info().mm_per_count[kX], 0.37 * k,
                1e-6);
  }
}

}  // namespace contract_test
}  // namespace twin::hal

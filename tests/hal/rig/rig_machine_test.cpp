#include "hal/rig/rig_machine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_rig.hpp"
#include "tests/support/allocations.hpp"

namespace twin::hal::rig {
namespace rig_machine_test {

using test::FakeRig;
using test::wrote;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using RigMachineTest = FakeRig;

TEST_F(RigMachineTest, SaysWhetherItIsSimulatedAndHasTheTablesScales) {
  const auto emulated = make();
  EXPECT_EQ(emulated->info().name, "rig");
  EXPECT_TRUE(emulated->info().simulated && emulated->info().has_truth);
  EXPECT_FALSE(emulated->info().follows_reference);
  EXPECT_THAT(emulated->info().mm_per_count, ElementsAre(0.005, -0.002));
  EXPECT_THAT(emulated->info().mm_per_s_per_volt, ElementsAre(80.0, 90.0));
  settings.axis[kY].encoder_reversed = true;
  settings.axis[kY].mm_per_count = 0.001;
  const auto real = make(false);
  EXPECT_FALSE(real->info().simulated || real->info().has_truth);
  EXPECT_THAT(real->info().mm_per_count, ElementsAre(0.005, -0.001));
}

TEST_F(RigMachineTest, ConfigureLeavesZeroVoltsAndServoOff) {
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  EXPECT_TRUE(is_safe());
  EXPECT_EQ(bench->period, kPeriod);
  EXPECT_EQ(machine->state(), State::kInactive);
  for (const double period : {0.0, -1.0, std::nan("")}) {
    EXPECT_FALSE(checked(machine->configure(period)));
  }
}

TEST_F(RigMachineTest, ActivationMakesThePresentPositionZeroAndLetsNoTimePass) {
  pci1784.answers = {{0x00, 0}, {0x04, 0}};
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  pci1784.answers = {{0x00, 700}, {0x04, 0xFFFFFF00}};
  bench->at.table_position = {3.0, 4.0};
  ASSERT_TRUE(checked(machine->activate()));
  EXPECT_EQ(bench->advances, 0);
  EXPECT_TRUE(is_safe()) << "nothing is on before the first write";
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  EXPECT_EQ(bench->advances, 1);
  EXPECT_THAT(inputs.counts, ElementsAre(0, 0));
  pci1784.answers[0x04] = 0xFFFFFF10;
  bench->at.table_position = {3.5, 2.0};
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  EXPECT_THAT(inputs.counts, ElementsAre(0, 16));
  EXPECT_THAT(machine->truth().table_position, ElementsAre(0.5, -2.0));
}

TEST_F(RigMachineTest, EachSignalIsThatOfItsOwnAxis) {
  settings.axis[kX].counter = 3;
  const auto machine = running();
  pci1716.answers[kDigital] = 0b0110'1011;  // X: ready, P-OT; Y: alarm, ready, N-OT
  pci1784.answers = {{0x0C, 5}, {0x04, 9}, {0x20, 0x800}};
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  EXPECT_THAT(inputs.counts, ElementsAre(5, 9));
  EXPECT_THAT(inputs.servo_ready, ElementsAre(true, true));
  EXPECT_THAT(inputs.alarm, ElementsAre(false, true));
  EXPECT_THAT(inputs.limit_positive, ElementsAre(true, false));
  EXPECT_THAT(inputs.limit_negative, ElementsAre(false, true));
  EXPECT_THAT(inputs.index, ElementsAre(true, false));
}

TEST_F(RigMachineTest, WritesDigitalOutputsFirstAndConvertersLast) {
  settings.axis[kX].dac = 1;
  settings.axis[kY].dac = 0;
  settings.axis[kX].vref_trim = 0.25;
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  ASSERT_TRUE(checked(machine->activate()));
  pci1716.log.clear();
  Outputs outputs;
  outputs.volts = {2.25, -5.0};
  outputs.servo_on = {true, false};
  outputs.position_reference = {0, 0, 7.5};
  ASSERT_EQ(machine->write(outputs), Status::kOk);
  EXPECT_THAT(pci1716.log, ElementsAre(wrote(0x10, 16, 0b0001), wrote(0x0A, 16, 0x4000),
                                       wrote(0x0C, 16, 0xA000)));
  EXPECT_EQ(bench->pen, 7.5);
}

TEST_F(RigMachineTest, AnAlarmIsResetByAPulseOnItsOwnDriveOnly) {
  settings.alarm_reset_time = 3e-3;
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  pci1716.answers[kDigital] = kHealthy & ~(1 << 4);  // Y
  pci1716.on_write = [this](const test::Access& access) {
    if (access.offset == kDigital && (access.value & 1 << 3) != 0) {
      pci1716.answers[kDigital] = kHealthy;
    }
  };
  pci1716.log.clear();
  ASSERT_TRUE(checked(machine->activate()));
  std::vector<std::uint32_t> outputs;
  for (const test::Access& access : pci1716.writes()) {
    if (access.offset == kDigital) {
      outputs.push_back(access.value);
    }
  }
  EXPECT_THAT(outputs, ElementsAre(0, 1 << 3, 0));
  EXPECT_EQ(bench->advances, 6) << "the pulse and a rest of the same length";
  EXPECT_TRUE(is_safe());
}

TEST_F(RigMachineTest, RefusesADriveWhoseAlarmStays) {
  settings.alarm_reset_time = 1e-3;
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  pci1716.answers[kDigital] = kHealthy & ~(1 << 0);
  const auto active = checked(machine->activate());
  ASSERT_FALSE(active);
  EXPECT_THAT(active.error().message, HasSubstr("axis x: the drive has an alarm"));
  EXPECT_THAT(active.error().message, HasSubstr("DI 0 is low"));
  EXPECT_TRUE(is_safe());
  EXPECT_EQ(machine->state(), State::kInactive);
  pci1716.answers[kDigital] = kHealthy;
  EXPECT_TRUE(checked(machine->activate()));
}

TEST_F(RigMachineTest, RefusesAnAxisAtBothItsLimits) {
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  pci1716.answers[kDigital] = kHealthy & ~(0b11 << 6);
  const auto active = checked(machine->activate());
  ASSERT_FALSE(active);
  EXPECT_THAT(active.error().message, HasSubstr("axis y: both limit switches are off at once"));
  EXPECT_TRUE(is_safe());
}

TEST_F(RigMachineTest, DeactivateIsZeroVoltsFirstAndServoOffSecond) {
  const auto machine = running();
  pci1716.log.clear();
  machine->deactivate();
  ASSERT_FALSE(pci1716.log.empty());
  EXPECT_EQ(pci1716.log.front(), wrote(kDac0, 16, 0x8000));
  EXPECT_EQ(pci1716.log.back(), wrote(kDigital, 16, 0));
  EXPECT_EQ(machine->state(), State::kInactive);
  EXPECT_EQ(machine->write({}), Status::kError);
  EXPECT_TRUE(is_safe());
  EXPECT_TRUE(checked(machine->activate()));
}

TEST_F(RigMachineTest, ItsEndIsSafe) {
  { const auto machine = running(); }
  EXPECT_TRUE(is_safe());
}

TEST_F(RigMachineTest, NoCardsNoMachine) {
  RigMachine machine(
      settings, {}, [] { return fail(ErrorCode::kMachine, "no card"); }, nullptr);
  const auto configured = checked(machine.configure(kPeriod));
  ASSERT_FALSE(configured);
  EXPECT_EQ(configured.error().message, "no card");
  EXPECT_FALSE(checked(machine.activate()));
  EXPECT_EQ(machine.read(inputs), Status::kError);
  machine.deactivate();
  EXPECT_EQ(machine.truth().table_position[kX], 0.0);
}

TEST_F(RigMachineTest, ReadAndWriteAllocateNothing) {
  const auto machine = running();
  pci1716.is_recording = pci1784.is_recording = false;
  int failures = 0;
  Outputs outputs;
  outputs.servo_on = {true, true};
  const std::int64_t before = test::allocations();
  for (int k = 0; k < 200; ++k) {
    failures += machine->read(inputs) != Status::kOk;
    outputs.volts = {0.01 * k, -0.02 * k};
    failures += machine->write(outputs) != Status::kOk;
    failures += machine->truth().table_position[kX] != 0.0;
  }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_EQ(failures, 0);
}

}  // namespace rig_machine_test
}  // namespace twin::hal::rig

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <limits>

#include "fake_rig.hpp"

// Whatever goes wrong, the converters end at 0 V and the servos off.
namespace twin::hal::rig {
namespace rig_faults_test {

using ::testing::HasSubstr;

using RigFaults = test::FakeRig;

TEST_F(RigFaults, AVanishedPci1716IsNamed) {
  const auto machine = running();
  pci1716.is_gone = true;
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_EQ(machine->last_error(), "the PCI-1716 no longer answers: its registers read all ones");
  EXPECT_TRUE(is_safe());
  EXPECT_EQ(machine->read(inputs), Status::kError) << "it stays so";
}

TEST_F(RigFaults, AVanishedPci1784IsNamed) {
  const auto machine = running();
  pci1784.is_gone = true;
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_EQ(machine->last_error(), "the PCI-1784 no longer answers: its registers read all ones");
  EXPECT_TRUE(is_safe());
  EXPECT_FALSE(checked(machine->activate()));
  pci1784.is_gone = false;
  EXPECT_TRUE(checked(machine->activate())) << "plugged in again";
  EXPECT_EQ(machine->last_error(), "");
}

TEST_F(RigFaults, AccessesThatFailAreErrors) {
  const auto machine = running();
  pci1784.errno_value = ENODEV;
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_EQ(machine->last_error(), "an access to the PCI-1784's registers failed: No such device");
  EXPECT_TRUE(is_safe());
}

TEST_F(RigFaults, AWriteThatFailsIsAnError) {
  const auto machine = running();
  pci1716.errno_value = EIO;
  Outputs outputs;
  outputs.volts = {1.0, 1.0};
  outputs.servo_on = {true, true};
  EXPECT_EQ(machine->write(outputs), Status::kError);
  EXPECT_THAT(machine->last_error(), HasSubstr("the PCI-1716's registers failed"));
  EXPECT_TRUE(is_safe());
  pci1716.errno_value = EPERM;
  EXPECT_THAT(machine->last_error(), HasSubstr("kernel lockdown (Secure Boot) may forbid it"));
}

TEST_F(RigFaults, VoltsThatAreNotFiniteReachNoConverter) {
  constexpr double kBad[] = {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()};
  for (const double bad : kBad) {
    for (int which = 0; which < 3; ++which) {
      const auto machine = running();
      Outputs outputs;
      outputs.servo_on = {true, true};
      outputs.volts = {which == 0 ? bad : 3.0, which == 1 ? bad : 3.0};
      outputs.position_reference[2] = which == 2 ? bad : 0.0;
      EXPECT_EQ(machine->write(outputs), Status::kError);
      EXPECT_THAT(machine->last_error(), HasSubstr("not a finite number"));
      EXPECT_TRUE(is_safe());
      EXPECT_TRUE(checked(machine->activate()));
    }
  }
}

TEST_F(RigFaults, ABenchThatBreaksIsAnError) {
  const auto machine = running();
  bench->is_broken = true;
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_EQ(machine->last_error(), "the bench broke");
  EXPECT_TRUE(is_safe());
  EXPECT_FALSE(checked(make()->configure(kPeriod)));
}

TEST_F(RigFaults, HeartbeatsBeginWithTheFirstWriteAndEndAfterTheOutputsAreSafe) {
  const auto machine = make();
  ASSERT_TRUE(checked(machine->configure(kPeriod)));
  ASSERT_TRUE(checked(machine->activate()));
  ASSERT_EQ(machine->read(inputs), Status::kOk);
  EXPECT_EQ(watch.arms + watch.beats, 0);
  for (int k = 0; k < 5; ++k) {
    ASSERT_EQ(machine->write({}), Status::kOk);
  }
  EXPECT_EQ(watch.arms, 1);
  EXPECT_EQ(watch.beats, 5);
  EXPECT_EQ(watch.disarms, 0);
  machine->deactivate();
  machine->deactivate();
  EXPECT_EQ(watch.disarms, 1);
  ASSERT_TRUE(checked(machine->activate()));
  ASSERT_EQ(machine->write({}), Status::kOk);
  EXPECT_EQ(watch.arms, 2);
}

TEST_F(RigFaults, NothingMovesAfterTheGuardHasActed) {
  const auto machine = running();
  watch.acted = true;
  pci1716.log.clear();
  Outputs outputs;
  outputs.volts = {5.0, 5.0};
  outputs.servo_on = {true, true};
  EXPECT_EQ(machine->write(outputs), Status::kError);
  EXPECT_THAT(machine->last_error(), HasSubstr("the guard has made the outputs safe"));
  for (const test::Access& access : pci1716.writes()) {
    EXPECT_TRUE(access.value == 0x8000 || access.value == 0x0101 || access.value == 0);
  }
  EXPECT_FALSE(checked(machine->activate()));
}

TEST_F(RigFaults, AGuardThatActsDuringAWriteHasTheLastWord) {
  const auto machine = running();
  watch.acts_at_beat = watch.beats + 1;
  Outputs outputs;
  outputs.volts = {5.0, 5.0};
  outputs.servo_on = {true, true};
  EXPECT_EQ(machine->write(outputs), Status::kError);
  EXPECT_TRUE(is_safe());
}

TEST_F(RigFaults, AGuardThatHasActedIsSeenByRead) {
  const auto machine = running();
  watch.acted = true;
  EXPECT_EQ(machine->read(inputs), Status::kError);
  EXPECT_TRUE(is_safe());
}

TEST_F(RigFaults, CardsThatDoNotAnswerAreNotOpened) {
  pci1716.is_gone = true;
  auto machine = make();
  auto configured = checked(machine->configure(kPeriod));
  ASSERT_FALSE(configured);
  EXPECT_THAT(configured.error().message, HasSubstr("PCI-1716"));
  pci1716.is_gone = false;
  pci1784.is_gone = true;
  configured = checked(machine->configure(kPeriod));
  ASSERT_FALSE(configured);
  EXPECT_THAT(configured.error().message, HasSubstr("PCI-1784"));
  EXPECT_TRUE(is_safe());
}

}  // namespace rig_faults_test
}  // namespace twin::hal::rig

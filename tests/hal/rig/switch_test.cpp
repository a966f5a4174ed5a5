#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/emulated_machine.hpp"
#include "tests/support/table_files.hpp"

// The switch: the simulated table and the drivers over emulated cards are the same machine.
namespace twin::hal::rig {
namespace switch_test {

using ::testing::HasSubstr;

constexpr double kPeriod = 1e-3;  // [s]

class Switch : public ::testing::Test {
 protected:
  Switch() { table.model = test::mjcf_file("xy_table.xml"); }

  std::unique_ptr<RigMachine> make() {
    bench = std::make_shared<emulator::EmulatedRig>(table, settings);
    return test::make_emulated(table, bench, settings);
  }
  static Outputs outputs(int k) {
    Outputs o;
    o.volts = {2.0 * std::sin(0.01 * k), -std::sin(0.013 * k)};
    o.servo_on = {k < 1800, k < 1700};
    o.position_reference[2] = 0.001 * k;
    return o;
  }
  // Runs both with the same motion; signs of the rig's wires are in its scales.
  void expect_same_motion() {
    mujoco::MujocoMachine simulated(table);
    const auto rig = make();
    ASSERT_TRUE(checked(simulated.configure(kPeriod)) && checked(simulated.activate()));
    ASSERT_TRUE(checked(rig->configure(kPeriod)) && checked(rig->activate()));
    Inputs a, b;
    for (int k = 0; k < 2000; ++k) {
      ASSERT_EQ(simulated.read(a), Status::kOk);
      ASSERT_EQ(rig->read(b), Status::kOk) << rig->last_error();
      Outputs turned = outputs(k);
      for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
        const double ratio = rig->info().mm_per_count[axis] / simulated.info().mm_per_count[axis];
        ASSERT_EQ(a.counts[axis], b.counts[axis] * std::lround(ratio)) << k;
        turned.volts[axis] *=
            simulated.info().mm_per_s_per_volt[axis] / rig->info().mm_per_s_per_volt[axis];
      }
      ASSERT_EQ(a.servo_ready, b.servo_ready) << k;
      ASSERT_EQ(a.alarm, b.alarm) << k;
      ASSERT_EQ(a.limit_positive, b.limit_positive) << k;
      ASSERT_EQ(a.limit_negative, b.limit_negative) << k;
      ASSERT_EQ(simulated.truth().table_position, rig->truth().table_position) << k;
      ASSERT_EQ(simulated.write(outputs(k)), Status::kOk);
      ASSERT_EQ(rig->write(turned), Status::kOk) << rig->last_error();
    }
  }

  mujoco::TableParams table;
  RigSettings settings;
  std::shared_ptr<emulator::EmulatedRig> bench;
};

TEST_F(Switch, BothMachinesGiveTheSameBitsInEveryPeriod) { expect_same_motion(); }

TEST_F(Switch, OtherPinsAndSignsAreTheSameMotion) {
  std::swap(settings.axis[kX].dac, settings.axis[kY].dac);
  settings.axis[kX].counter = 3;
  settings.axis[kY].counter = 2;
  settings.axis[kX].vref_reversed = true;
  settings.axis[kY].encoder_reversed = true;
  settings.axis[kX].servo_on = {9, Level::kLow};
  settings.axis[kY].alarm = {12, Level::kHigh};
  settings.axis[kX].ready = {15, Level::kLow};
  expect_same_motion();
}

TEST_F(Switch, AnAlarmIsResetByActivationAndABrokenWireIsNot) {
  settings.alarm_reset_time = 0.01;
  const auto rig = make();
  ASSERT_TRUE(checked(rig->configure(kPeriod)) && checked(rig->activate()));
  Inputs inputs;
  bench->inject({emulator::FaultKind::kAlarm, kY, 0.0});
  ASSERT_EQ(rig->read(inputs), Status::kOk);
  EXPECT_FALSE(inputs.alarm[kX]);
  EXPECT_TRUE(inputs.alarm[kY]);
  rig->deactivate();
  ASSERT_TRUE(checked(rig->activate()));
  bench->inject({emulator::FaultKind::kWireBroken, kX, 0.0});
  ASSERT_EQ(rig->read(inputs), Status::kOk);
  EXPECT_TRUE(inputs.alarm[kX]);
  rig->deactivate();
  const auto active = checked(rig->activate());
  ASSERT_FALSE(active);
  EXPECT_THAT(active.error().message, HasSubstr("axis x: the drive has an alarm"));
}

TEST_F(Switch, ACardThatVanishesIsNamed) {
  for (const emulator::FaultKind gone :
       {emulator::FaultKind::kCardGone1716, emulator::FaultKind::kCardGone1784}) {
    const auto rig = make();
    ASSERT_TRUE(checked(rig->configure(kPeriod)) && checked(rig->activate()));
    Inputs inputs;
    ASSERT_EQ(rig->read(inputs), Status::kOk);
    bench->inject({gone, kX, 0.0});
    EXPECT_EQ(rig->read(inputs), Status::kError);
    EXPECT_THAT(rig->last_error(),
                HasSubstr(gone == emulator::FaultKind::kCardGone1716 ? "PCI-1716" : "PCI-1784"));
    EXPECT_FALSE(checked(rig->activate()));
  }
}

}  // namespace switch_test
}  // namespace twin::hal::rig

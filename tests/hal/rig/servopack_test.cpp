#include "hal/rig/servopack.hpp"

#include <gtest/gtest.h>

namespace twin::hal::rig {
namespace servopack_test {

// Default wiring: ALM, S-RDY, P-OT, N-OT on DI 0 to 3 (X) and 4 to 7 (Y).
constexpr std::uint16_t kHealthy = 0b1101'1101;  // no alarm, not ready, no limit

TEST(Servopack, HealthyInputsAreNoAlarmAndNoLimit) {
  for (const AxisWiring& wiring : RigSettings{}.axis) {
    const DriveInputs drive = Servopack(wiring).decode(kHealthy, true);
    EXPECT_FALSE(drive.alarm || drive.ready || drive.limit_positive || drive.limit_negative);
  }
}

TEST(Servopack, EachInputIsReadFromItsOwnLine) {
  const Servopack y(default_y_wiring());
  EXPECT_TRUE(y.decode(kHealthy & ~(1 << 4), false).alarm);
  EXPECT_TRUE(y.decode(kHealthy | (1 << 5), true).ready);
  EXPECT_FALSE(y.decode(kHealthy | (1 << 5), false).ready) << "it would take /S-ON";
  EXPECT_TRUE(y.decode(kHealthy & ~(1 << 6), false).limit_positive);
  EXPECT_TRUE(y.decode(kHealthy & ~(1 << 7), false).limit_negative);
  EXPECT_FALSE(y.decode(kHealthy & ~(1 << 0), false).alarm) << "that is X";
}

TEST(Servopack, ABrokenCableIsAnAlarmBothLimitsAndNotReady) {
  const DriveInputs drive = Servopack(AxisWiring{}).decode(0, true);
  EXPECT_TRUE(drive.alarm);
  EXPECT_TRUE(drive.limit_positive && drive.limit_negative);
  EXPECT_FALSE(drive.ready);
}

TEST(Servopack, TheLevelOfALineTurnsItsMeaning) {
  AxisWiring wiring;
  wiring.alarm.when = Level::kHigh;
  wiring.ready.when = Level::kLow;
  const DriveInputs drive = Servopack(wiring).decode(0b1101, true);
  EXPECT_TRUE(drive.alarm);
  EXPECT_TRUE(drive.ready);
}

TEST(Servopack, LinesThatAreNotWiredSayNothing) {
  AxisWiring wiring;
  wiring.ready.channel = wiring.limit_positive.channel = wiring.limit_negative.channel = -1;
  wiring.alarm_reset.channel = -1;
  const Servopack drive(wiring);
  for (const int levels : {0x0000, 0xFFFF}) {
    const DriveInputs inputs = drive.decode(static_cast<std::uint16_t>(levels), false);
    EXPECT_FALSE(inputs.ready || inputs.limit_positive || inputs.limit_negative);
    EXPECT_TRUE(drive.decode(static_cast<std::uint16_t>(levels), true).ready) << "taken as asked";
  }
  EXPECT_EQ(drive.with_outputs(false, true, 0), 0);
}

TEST(Servopack, OutputsAreSetAtTheirLevelAndLeaveOthersAlone) {
  AxisWiring wiring;
  const Servopack drive(wiring);
  EXPECT_EQ(drive.with_outputs(true, false, 0), 0b01);
  EXPECT_EQ(drive.with_outputs(false, true, 0b01), 0b10);
  EXPECT_EQ(drive.with_outputs(true, true, 0xF0F0), 0xF0F3);
  wiring.servo_on.when = Level::kLow;
  EXPECT_EQ(Servopack(wiring).with_outputs(true, false, 0xFFFF), 0xFFFC);
  EXPECT_EQ(Servopack(wiring).with_outputs(false, false, 0), 0b01);
}

TEST(Servopack, SafeOutputsHaveNoSignalGiven) {
  RigSettings settings;
  EXPECT_EQ(safe_digital(settings), 0);
  settings.axis[kX].servo_on = {9, Level::kLow};
  settings.axis[kY].alarm_reset = {15, Level::kLow};
  EXPECT_EQ(safe_digital(settings), 1 << 9 | 1 << 15);
}

TEST(Servopack, TheTrimIsAddedOnlyWhileTheServoIsOn) {
  AxisWiring wiring;
  wiring.vref_trim = -0.02;
  const Servopack drive(wiring);
  EXPECT_DOUBLE_EQ(drive.vref(1.5, true), 1.48);
  EXPECT_DOUBLE_EQ(drive.vref(0.0, false), 0.0);
  EXPECT_DOUBLE_EQ(Servopack(AxisWiring{}).vref(1.5, true), 1.5);
}

TEST(Servopack, ScalesAreTheTablesWhereTheSettingIsZeroAndReversedWhereItSays) {
  AxisWiring wiring;
  EXPECT_DOUBLE_EQ(Servopack(wiring).mm_per_count(-0.002), -0.002);
  EXPECT_DOUBLE_EQ(Servopack(wiring).mm_per_s_per_volt(83.0), 83.0);
  wiring.mm_per_count = 0.001;
  wiring.encoder_reversed = true;
  wiring.mm_per_s_per_volt = 50.0;
  EXPECT_DOUBLE_EQ(Servopack(wiring).mm_per_count(7.0), -0.001);
  EXPECT_DOUBLE_EQ(Servopack(wiring).mm_per_s_per_volt(7.0), 50.0);
  wiring.vref_reversed = true;
  EXPECT_DOUBLE_EQ(Servopack(wiring).mm_per_s_per_volt(7.0), -50.0);
}

TEST(DriveCheck, NamesAxisSignalAndChannel) {
  const RigSettings settings;
  EXPECT_TRUE(check_drives(settings, kHealthy));
  const auto message = [&](int levels) {
    const auto checked = check_drives(settings, static_cast<std::uint16_t>(levels));
    EXPECT_FALSE(checked);
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(message(kHealthy & ~(1 << 4))
                .rfind("axis y: the drive has an alarm after its reset "
                       "(ALM, DI 4 is low)",
                       0),
            0u);
  EXPECT_EQ(message(kHealthy & ~(0b11 << 2))
                .rfind("axis x: both limit switches are off at once "
                       "(P-OT, DI 2 is low; N-OT, DI 3 is low)",
                       0),
            0u);
  EXPECT_TRUE(check_drives(settings, kHealthy & ~(1 << 2))) << "one limit is where a table may be";
}

}  // namespace servopack_test
}  // namespace twin::hal::rig

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/machine_file.hpp"

namespace twin::config {
namespace rig_settings_test {

using hal::rig::Driver;
using hal::rig::Level;
using hal::rig::RigSettings;
using hal::rig::io_port::Access;
using ::testing::HasSubstr;

std::string refusal(std::string_view text) {
  const auto machine = parse_machine_file(text, "desk.toml");
  EXPECT_FALSE(machine) << text;
  return machine ? "" : to_string(machine.error());
}

TEST(RigSection, ValuesComeIntoTheirFields) {
  const auto machine = parse_machine_file(R"(
    [rig]
    driver = "daqnavi"
    access = "ioperm"
    sysfs = "/tmp/sys"
    daqnavi_library = "/opt/advantech/libs/libbiodaq.so"
    pci1716_board_id = 3
    pci1784_board_id = 15
    counter_mode = 0x103
    clock_control = 0x01020304
    reset_counters = true
    counter_reset_offset = 0x3C
    read_index = false
    alarm_reset_time_ms = 250
    [rig.x]
    dac = 1
    counter = 2
    vref_reversed = true
    encoder_um_per_count = 0.5
    vref_scale_mm_per_s_per_V = 83.5
    vref_trim_V = -0.01
    [rig.y]
    dac = 0
    encoder_reversed = true
    servo_on_do = 15
    servo_on_level = "low"
    alarm_di = 14
    alarm_level = "high"
    ready_di = -1
    vref_readback_ai = 7
  )",
                                          "desk.toml");
  ASSERT_TRUE(machine) << to_string(machine.error());
  const RigSettings& rig = machine->rig;
  EXPECT_EQ(rig.driver, Driver::kDaqnavi);
  EXPECT_EQ(rig.access, Access::kIoperm);
  EXPECT_EQ(rig.sysfs, "/tmp/sys");
  EXPECT_EQ(rig.daqnavi_library, "/opt/advantech/libs/libbiodaq.so");
  EXPECT_EQ(rig.pci1716_board_id, 3);
  EXPECT_EQ(rig.pci1784_board_id, 15);
  EXPECT_EQ(rig.counter_mode, 0x103);
  EXPECT_EQ(rig.clock_control, 0x01020304);
  EXPECT_TRUE(rig.reset_counters);
  EXPECT_EQ(rig.counter_reset_offset, 0x3C);
  EXPECT_FALSE(rig.read_index);
  EXPECT_DOUBLE_EQ(rig.alarm_reset_time, 0.25);
  const auto& x = rig.axis[hal::kX];
  EXPECT_EQ(x.dac, 1);
  EXPECT_EQ(x.counter, 2);
  EXPECT_TRUE(x.vref_reversed);
  EXPECT_FALSE(x.encoder_reversed);
  EXPECT_DOUBLE_EQ(x.mm_per_count, 0.0005);
  EXPECT_DOUBLE_EQ(x.mm_per_s_per_volt, 83.5);
  EXPECT_DOUBLE_EQ(x.vref_trim, -0.01);
  const auto& y = rig.axis[hal::kY];
  EXPECT_TRUE(y.encoder_reversed);
  EXPECT_EQ(y.servo_on.channel, 15);
  EXPECT_EQ(y.servo_on.when, Level::kLow);
  EXPECT_EQ(y.alarm.channel, 14);
  EXPECT_EQ(y.alarm.when, Level::kHigh);
  EXPECT_EQ(y.ready.channel, -1);
  EXPECT_EQ(y.vref_readback, 7);
}

TEST(RigSection, WhatIsWrittenReadsBackTheSame) {
  MachineFile machine;
  machine.rig.driver = Driver::kDaqnavi;
  machine.rig.reset_counters = true;
  machine.rig.axis[hal::kX].limit_positive = {11, Level::kHigh};
  machine.rig.axis[hal::kY].mm_per_count = 0.00025;
  const std::string text = to_toml(machine);
  const auto again = parse_machine_file(text, "a.toml");
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(again->rig.driver, Driver::kDaqnavi);
  EXPECT_EQ(again->rig.axis[hal::kX].limit_positive.channel, 11);
  EXPECT_EQ(again->rig.axis[hal::kX].limit_positive.when, Level::kHigh);
  EXPECT_DOUBLE_EQ(again->rig.axis[hal::kY].mm_per_count, 0.00025);
  EXPECT_THAT(text, HasSubstr("reset_counters = true"));
  EXPECT_THAT(text, HasSubstr("(true, false)"));
}

TEST(RigSection, RefusalsNamePlaceValueAndRange) {
  EXPECT_EQ(refusal("[rig]\ndriver = \"register\"\n"),
            "desk.toml:2:10: rig.driver = \"register\" is not one of registers, daqnavi; did you "
            "mean registers?");
  EXPECT_EQ(refusal("[rig]\n\npci1716_board_id = 16\n"),
            "desk.toml:3:20: rig.pci1716_board_id = 16 is out of range: 0 to 15");
  EXPECT_EQ(refusal("[rig]\nread_index = 1\n"),
            "desk.toml:2:14: rig.read_index = 1 is not true or false");
  EXPECT_EQ(refusal("[rig.x]\nalarm_di = -1\n"),
            "desk.toml:2:12: rig.x.alarm_di = -1 is out of range: 0 to 15");
  EXPECT_EQ(refusal("[rig.y]\ndac = 2\n"), "desk.toml:2:7: rig.y.dac = 2 is out of range: 0 to 1");
  EXPECT_EQ(refusal("[rig.y]\nvref_scale_mm_per_s_per_V = -1\n"),
            "desk.toml:2:29: rig.y.vref_scale_mm_per_s_per_V = -1 mm/s per V is out of range: 0 to "
            "1000 mm/s per V");
  EXPECT_THAT(refusal("[rig.x]\nservo_on_level = \"up\"\n"), HasSubstr("one of low, high"));
  EXPECT_THAT(
      refusal("[rig.x]\nservo_on_d0 = 1\n"),
      HasSubstr("desk.toml:2:1: unknown key servo_on_d0 in [rig.x]; did you mean servo_on_do?"));
  EXPECT_THAT(refusal("[rig.z]\ndac = 1\n"), HasSubstr("unknown section [rig.z]"));
}

TEST(RigSection, WhatIsUsedTwiceIsRefusedWithBothKeys) {
  EXPECT_EQ(refusal("[rig.x]\ndac = 1\n"),
            "desk.toml: rig.x.dac and rig.y.dac are both analogue output 1");
  EXPECT_EQ(refusal("[rig.y]\ncounter = 0\n"),
            "desk.toml: rig.x.counter and rig.y.counter are both counter 0");
  EXPECT_EQ(refusal("[rig.x]\nalarm_reset_do = 0\n"),
            "desk.toml: rig.x.servo_on_do and rig.x.alarm_reset_do are both digital output 0");
  EXPECT_EQ(refusal("[rig.y]\nlimit_negative_di = 2\n"),
            "desk.toml: rig.x.limit_positive_di and rig.y.limit_negative_di are both digital "
            "input 2");
  EXPECT_EQ(refusal("[rig.x]\nvref_readback_ai = 1\n[rig.y]\nvref_readback_ai = 1\n"),
            "desk.toml: rig.x.vref_readback_ai and rig.y.vref_readback_ai are both analogue "
            "input 1");
  EXPECT_THAT(refusal("[rig]\ncounter_reset_offset = 45\n"), HasSubstr("no multiple of 4"));
}

TEST(RigSection, LinesThatAreNotWiredMayBeSeveral) {
  const auto machine = parse_machine_file(
      "[rig.x]\nready_di = -1\nlimit_positive_di = -1\nalarm_reset_do = -1\n"
      "[rig.y]\nready_di = -1\nalarm_reset_do = -1\n",
      "desk.toml");
  EXPECT_TRUE(machine) << to_string(machine.error());
}

TEST(RigSection, AnOverrideIsCheckedWithTheRest) {
  const std::string sets[] = {"rig.x.dac=1"};
  const auto machine = parse_machine_file("", "desk.toml", sets);
  ASSERT_FALSE(machine);
  EXPECT_EQ(machine.error().code, ErrorCode::kUsage);
  const std::string both[] = {"rig.x.dac=1", "rig.y.dac=0", "rig.read_index=false"};
  const auto swapped = parse_machine_file("", "desk.toml", both);
  ASSERT_TRUE(swapped) << to_string(swapped.error());
  EXPECT_FALSE(swapped->rig.read_index);
}

}  // namespace rig_settings_test
}  // namespace twin::config

#include "studies/linuxcnc/machine_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/support/table_files.hpp"

namespace twin::studies::linuxcnc {
namespace machine_config_test {

using ::testing::HasSubstr;
using ::testing::Not;

config::MachineFile machine(std::vector<std::string> settings = {}) {
  auto read = config::read_machine_file(test::mjcf_file("xy_table.toml"), settings);
  EXPECT_TRUE(read);
  return read.value_or(config::MachineFile());
}

/// Value of a key in a section of an INI file.
std::string value_of(const std::string& ini, const std::string& section, const std::string& key) {
  const std::size_t begin = ini.find("[" + section + "]\n");
  const std::size_t end = ini.find("\n[", begin + 1);
  const std::string part = "\n" + ini.substr(begin, end - begin) + "\n";
  const std::string wanted = "\n" + key + " = ";
  const std::size_t at = part.find(wanted);
  if (begin == std::string::npos || at == std::string::npos) {
    return "none";
  }
  const std::size_t value = at + wanted.size();
  return part.substr(value, part.find('\n', value) - value);
}

TEST(LinuxCncConfig, HasScalesAndGainsOfTheMachineFile) {
  const std::string ini = ini_text(machine(), {});
  EXPECT_NEAR(std::stod(value_of(ini, "JOINT_0", "INPUT_SCALE")), 147.977, 0.001);
  EXPECT_NEAR(std::stod(value_of(ini, "JOINT_1", "INPUT_SCALE")), 86.625, 0.001);
  EXPECT_NEAR(std::stod(value_of(ini, "JOINT_0", "OUTPUT_SCALE")), 1.0 / 83.333, 1e-6);
  EXPECT_EQ(value_of(ini, "JOINT_0", "P"), "298.63");
  EXPECT_EQ(value_of(ini, "JOINT_1", "FF1"), "1.0032");
  EXPECT_EQ(value_of(ini, "JOINT_1", "FF2"), "0.0025775");
  EXPECT_EQ(value_of(ini, "EMCMOT", "SERVO_PERIOD"), "1000000");
  EXPECT_EQ(value_of(ini, "JOINT_0", "MAX_ACCELERATION"), "2450");
  EXPECT_EQ(value_of(ini, "JOINT_0", "MAX_VELOCITY"), "100");
}

TEST(LinuxCncConfig, HomesOnTheSwitchOfTheMachineFile) {
  const std::string ini = ini_text(machine({"home.y.switch=p-ot", "home.y.zero_mm=-200"}), {});
  EXPECT_EQ(value_of(ini, "JOINT_0", "HOME_SEARCH_VEL"), "-10");
  EXPECT_EQ(value_of(ini, "JOINT_0", "HOME_LATCH_VEL"), "1");
  EXPECT_EQ(value_of(ini, "JOINT_0", "HOME_OFFSET"), "-205");
  EXPECT_EQ(value_of(ini, "JOINT_1", "HOME_SEARCH_VEL"), "10");
  EXPECT_EQ(value_of(ini, "JOINT_1", "HOME_OFFSET"), "200");
  ConfigOptions here;
  here.is_homed_here = true;
  EXPECT_EQ(value_of(ini_text(machine(), here), "JOINT_0", "HOME_SEARCH_VEL"), "0");
}

TEST(LinuxCncConfig, LooksForAnIndexOnlyWhereTheHalFilesConnectIt) {
  ConfigOptions options;
  EXPECT_EQ(value_of(ini_text(machine(), options), "JOINT_0", "HOME_USE_INDEX"), "YES");
  options.profile = ConfigOptions::Profile::kStg;
  EXPECT_EQ(value_of(ini_text(machine(), options), "JOINT_0", "HOME_USE_INDEX"), "NO");
}

TEST(LinuxCncConfig, LimitsOfAnAxisGoBeforeThoseOfTheMachine) {
  const std::string ini = ini_text(
      machine({"limits.axis_acceleration_mm_per_s2=[1000,2000,0]",
               "limits.axis_feedrate_mm_per_min=[2400,1200,0]", "interpolator.period_ms=0.5"}),
      {});
  EXPECT_EQ(value_of(ini, "JOINT_0", "MAX_ACCELERATION"), "1000");
  EXPECT_EQ(value_of(ini, "JOINT_1", "MAX_VELOCITY"), "20");
  EXPECT_EQ(value_of(ini, "EMCMOT", "SERVO_PERIOD"), "500000");
}

TEST(LinuxCncConfig, ShippedHalFilesAreNamedAsTheyAre) {
  ConfigOptions stg;
  stg.profile = ConfigOptions::Profile::kStg;
  stg.hal_files = "/files";
  const std::string ini = ini_text(machine(), stg);
  EXPECT_THAT(ini, HasSubstr("HALFILE = LIB:core_servo.hal\nHALFILE = /files/stg_motion.hal\n"
                             "HALFILE = /files/stg_io.hal\nHALFILE = stg_record.hal\n"));
  EXPECT_THAT(ini, Not(HasSubstr("twin.hal")));
}

}  // namespace machine_config_test
}  // namespace twin::studies::linuxcnc

#include "hal/mujoco/table_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <set>

#include "tests/support/table_files.hpp"

namespace twin::hal::mujoco {
namespace table_settings_test {

using ::testing::HasSubstr;

/// Every number of a section must be in the file, and nothing else but `others`.
void expect_section(const toml::table& file, const std::string& name,
                    const std::vector<Setting>& settings, std::set<std::string> others) {
  const toml::table* section = file.at_path(name).as_table();
  ASSERT_NE(section, nullptr) << name;
  for (const Setting& setting : settings) {
    const auto value = (*section)[setting.key].value<double>();
    ASSERT_TRUE(value) << name << "." << setting.key;
    EXPECT_GE(*value, setting.min) << setting.key;
    EXPECT_LE(*value, setting.max) << setting.key;
    EXPECT_FALSE(setting.doc.empty()) << setting.key;
    others.insert(std::string(setting.key));
  }
  for (const auto& [key, value] : *section) {
    EXPECT_TRUE(others.contains(std::string(key.str()))) << name << "." << key.str();
  }
}

void expect_file(const std::string& file_name) {
  const toml::table file = toml::parse_file(test::mjcf_file(file_name));
  TableParams params;
  expect_section(file, "table", table_settings(params), {"identified", "model", "x", "y"});
  expect_section(file, "table.x", axis_settings(params.axis[kX]),
                 {"dac_bits", "drive_mode", "encoder_at", "friction_law"});
  expect_section(file, "table.y", axis_settings(params.axis[kY]),
                 {"dac_bits", "drive_mode", "encoder_at", "friction_law"});
}

TEST(TableSettings, MachineFileHasEveryKey) { expect_file("xy_table.toml"); }

TEST(TableSettings, IdealMachineFileHasEveryKeyWithinItsRange) {
  expect_file("xy_table_ideal.toml");
}

TEST(TableSettings, DefaultsAreValid) { EXPECT_TRUE(validate(TableParams{})); }

TEST(TableSettings, PhysicsStepIsShortenedToDivideThePeriod) {
  EXPECT_EQ(steps_per_period(1e-3, 1e-4), 10);
  EXPECT_EQ(steps_per_period(0.25e-3, 1e-4), 3);
  EXPECT_EQ(steps_per_period(0.125e-3, 1e-4), 2);
  EXPECT_EQ(steps_per_period(0.125e-3, 1e-3), 1);
  for (int n = 1; n <= 4000; ++n) {
    EXPECT_EQ(steps_per_period(n * 1e-6, 1e-6), n);
  }
}

TEST(TableSettings, ValueOutOfRangeIsNamedWithItsUnit) {
  TableParams params;
  params.axis[kY].encoder.mm_per_count = 100.0;
  const auto refused = validate(params);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("table.y.encoder_um_per_count = 100000"));
}

TEST(TableSettings, NotANumberIsOutOfRange) {
  TableParams params;
  params.axis[kX].friction.coulomb = std::nan("");
  EXPECT_FALSE(validate(params));
}

TEST(TableSettings, ScalesOfZeroAreRefused) {
  TableParams params;
  params.axis[kX].encoder.mm_per_count = 0.0;
  EXPECT_FALSE(validate(params));
}

TEST(TableSettings, VelocityLoopTooFastForThePhysicsStepIsRefused) {
  TableParams params;
  params.axis[kX].drive.velocity_gain_Hz = 5000.0;
  const auto refused = validate(params);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("physics_step_ms of at most"));
}

}  // namespace table_settings_test
}  // namespace twin::hal::mujoco

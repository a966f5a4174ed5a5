#include "config/machine_file.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace twin::config {
namespace write_machine_test {

const SettingValue* find(const std::vector<Setting>& settings, const std::string& section,
                         const std::string& key) {
  for (const Setting& setting : settings) {
    if (setting.section == section && setting.key == key) {
      return &setting.value;
    }
  }
  return nullptr;
}

TEST(Settings, AreInTheUnitsOfTheirKeys) {
  MachineFile machine;
  machine.limits.feedrate = 200.0;
  machine.limits.axis_jerk = {1e4, 2e4, 0.0};
  machine.path.look_ahead = 77;
  const auto settings = settings_of(machine);
  EXPECT_EQ(*find(settings, "limits", "feedrate_mm_per_min"), SettingValue(12000.0));
  EXPECT_EQ(*find(settings, "limits", "axis_jerk_mm_per_s3"),
            SettingValue(std::vector<double>{1e4, 2e4, 0.0}));
  EXPECT_EQ(*find(settings, "planning", "planner"), SettingValue(std::string("certified")));
  EXPECT_EQ(*find(settings, "planning", "look_ahead"), SettingValue(std::int64_t{77}));
}

TEST(Settings, AreTheKeysOfTheMachineFile) {
  const MachineFile machine;
  std::istringstream toml(to_toml(machine));
  std::size_t keys = 0;
  for (std::string line; std::getline(toml, line);) {
    keys += line.find(" = ") < line.find('#') ? 1 : 0;
  }
  EXPECT_EQ(settings_of(machine).size(), keys);
}

}  // namespace write_machine_test
}  // namespace twin::config

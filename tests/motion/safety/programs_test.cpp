#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

// No monitor trips on a sound table: every program here, at its own feedrate and at the machine's
// largest, with limits of a half and less of the defaults.
namespace twin::runtime {
namespace programs_test {

namespace fs = std::filesystem;

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(TWIN_SOURCE_DIR "/nc_programs")) {
    if (entry.path().extension() == ".nc") {
      names.push_back(entry.path().stem().string());
    }
  }
  return names;
}

class SoundTable : public ::testing::TestWithParam<std::tuple<std::string, std::string, bool>> {};

TEST_P(SoundTable, TripsNoMonitorWithHalfTheLimits) {
  const auto& [program, machine_name, is_fast] = GetParam();
  const fs::path root(TWIN_SOURCE_DIR);
  test::TempFolder folder;
  RunRequest request;
  request.program = test::text_of(root / "nc_programs" / (program + ".nc"));
  request.machine = *config::read_machine_file(root / "mjcf" / (machine_name + ".toml"));
  request.directory = folder / "out";
  if (is_fast) {
    request.feedrate = request.machine.limits.feedrate;
  }
  request.machine.safety.tracking_error /= 2.0;
  request.machine.safety.tracking_error_per_feedrate /= 10.0;
  request.machine.safety.runaway /= 2.0;
  request.machine.safety.frozen_encoder /= 2.0;
  request.machine.safety.count_step_ratio /= 2.0;
  request.machine.safety.saturation_time = 0.0;
  hal::mujoco::MujocoMachine machine(request.machine.table);
  request.hal = &machine;
  const auto result = run_program(request);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_FALSE(result->failure) << to_string(*result->failure);
}

INSTANTIATE_TEST_SUITE_P(Programs, SoundTable,
                         ::testing::Combine(::testing::ValuesIn(programs()),
                                            ::testing::Values("xy_table", "xy_table_ideal"),
                                            ::testing::Bool()),
                         [](const auto& instance) {
                           return std::get<0>(instance.param) + "_" + std::get<1>(instance.param) +
                                  (std::get<2>(instance.param) ? "_fast" : "_as_programmed");
                         });

}  // namespace programs_test
}  // namespace twin::runtime

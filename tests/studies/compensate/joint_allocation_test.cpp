#include <gtest/gtest.h>

#include <memory>

#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "shadow/live_shadow.hpp"
#include "shadow/shadow.hpp"
#include "studies/compensate/corrected_run.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::compensate {
namespace joint_allocation_test {

/// Correction, learning and shadow beside one run on the wall clock: its motion thread allocates
/// nothing in any period.
TEST(Cycle, AllocatesNothingWithCorrectionShadowAndLearningTogether) {
  const test::TempFolder folder;
  auto read = config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml");
  ASSERT_TRUE(read) << to_string(read.error());
  config::MachineFile machine = *std::move(read);
  machine.realtime.max_late_periods = 1000000;  // on a loaded computer
  machine.realtime.max_stall = 1e3;
  const auto program = gcode::ProgramText::from_text(
      "G01 X6 F2400\nY4\nG03 X2 Y4 R2\nG01 X0 Y0\nX5 Y5\nX0 Y0\n", "corner.nc");
  auto corrected =
      CorrectedRun::prepare({.is_wanted = false, .file = {}, .learning = folder / "learnt"},
                            program, machine, std::nullopt, {});
  ASSERT_TRUE(corrected) << to_string(corrected.error());
  ASSERT_NE(corrected->correction(), nullptr);
  const auto healthy = twin::shadow::learn_from_model(machine, false, {});
  ASSERT_TRUE(healthy) << to_string(healthy.error());
  twin::shadow::LiveOptions live;
  live.is_wall_clock = true;
  twin::shadow::LiveShadow shadow(machine, *healthy, false, live);

  hal::mujoco::MujocoMachine table(machine.table);
  runtime::RunRequest request;
  request.program = program;
  request.machine = machine;
  request.hal = &table;
  request.is_wall_clock = true;
  request.correction = corrected->correction().get();
  request.sinks = {corrected->sink(), &shadow};
  std::int64_t last = test::allocations_of_thread();
  const auto one = std::make_unique<double>(0.0);
  ASSERT_EQ(test::allocations_of_thread(), last + 1);  // they are counted
  std::int64_t allocated = 0;
  std::int64_t periods = 0;
  request.hooks.before_period = [&](std::int64_t) {  // in the motion thread
    const std::int64_t now = test::allocations_of_thread();
    allocated += periods++ > 0 ? now - last : 0;
    last = now;
  };
  const auto result = runtime::run_program(request);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(periods, 1000);
  EXPECT_TRUE(shadow.report().switched_off.empty()) << shadow.report().switched_off;
  EXPECT_GT(shadow.report().periods, 500);
  const auto line = corrected->learn_from({});
  ASSERT_TRUE(line) << to_string(line.error());
  EXPECT_NE(line->find("learnt from 1 run"), std::string::npos) << *line;
}

}  // namespace joint_allocation_test
}  // namespace twin::studies::compensate

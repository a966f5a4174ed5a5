#include "runtime/program_check.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "hal/ideal/ideal_machine.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/program_text.hpp"

namespace twin::runtime {
namespace cycle_time_test {

/// Every NC program that is shipped, with every planner.
class CycleTime : public RunProgram, public ::testing::WithParamInterface<Planner> {};

TEST_P(CycleTime, IsWhatTheRunTakesWithinAPeriod) {
  request.machine.path.planner = GetParam();
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TWIN_SOURCE_DIR "/nc_programs")) {
    if (entry.path().extension() != ".nc") {
      continue;
    }
    ++count;
    request.program = test::text_of(entry.path());
    const auto estimate = estimate_program(request.program, {}, request.machine, nullptr);
    ASSERT_TRUE(estimate) << to_string(estimate.error());
    double shown = 0.0;
    request.estimated = [&](double time) { shown = time; };
    hal::ideal::IdealMachine machine;
    const auto result = run(&machine);
    ASSERT_TRUE(result && !result->failure) << entry.path();
    EXPECT_EQ(shown, estimate->plan.time);
    EXPECT_EQ(result->summary.planned_time, estimate->plan.time);
    EXPECT_GE(result->summary.run->machining_time, estimate->plan.time - 1e-9) << entry.path();
    EXPECT_LT(result->summary.run->machining_time, estimate->plan.time + request.machine.period)
        << entry.path();
  }
  EXPECT_GT(count, 3);
}

INSTANTIATE_TEST_SUITE_P(Planners, CycleTime,
                         ::testing::Values(Planner::kPaper, Planner::kCertified));

}  // namespace cycle_time_test
}  // namespace twin::runtime

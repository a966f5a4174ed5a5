#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "tests/runtime/run_fixture.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/files.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/trace_rows.hpp"

namespace twin::runtime {
namespace run_test {

using ::testing::HasSubstr;

TEST_F(RunProgram, PlanAloneHasTheCommandAndNoMachine) {
  const auto result = run(nullptr);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_FALSE(result->failure);
  EXPECT_FALSE(result->summary.run);
  const test::TraceRows rows(folder / "out/trace.csv");
  EXPECT_EQ(rows.columns(), 7U);
  EXPECT_EQ(rows.last("x_cmd_mm"), 0.0);
  EXPECT_EQ(rows.last("feedrate_mm_per_s"), 0.0);
}

TEST_F(RunProgram, IdealMachineHasTheErrorOfTheCommandAlone) {
  hal::ideal::IdealMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_FALSE(result->failure);
  const results::Summary& summary = result->summary;
  ASSERT_TRUE(summary.run);
  EXPECT_EQ(summary.hal, "ideal");
  EXPECT_EQ(summary.blocks.total, 4);
  EXPECT_EQ(summary.run->tracking_error[0].max, 0.0);
  EXPECT_EQ(summary.run->contour_error.max, summary.command_contour_error.max);
  EXPECT_LT(summary.command_contour_error.max, 0.010);
  // The machining time is the planned time rounded up to a period.
  EXPECT_GE(summary.run->machining_time, summary.planned_time - 1e-9);
  EXPECT_LT(summary.run->machining_time, summary.planned_time + request.machine.period);
  const test::TraceRows rows(folder / "out/trace.csv");
  EXPECT_EQ(rows.columns(), 16U);
  EXPECT_NEAR(rows.last("t_s"), summary.run->machining_time, 1e-12);
  EXPECT_EQ(machine.state(), hal::State::kUnconfigured);
}

TEST_F(RunProgram, SimulatedTableFollowsWithinMicrometres) {
  hal::mujoco::MujocoMachine machine(request.machine.table);
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_FALSE(result->failure);
  EXPECT_GT(result->summary.run->contour_error.rms, 0.0005);
  EXPECT_LT(result->summary.run->contour_error.rms, 0.010);
  EXPECT_LT(result->summary.run->contour_error.max, 0.040);
}

TEST_F(RunProgram, TwoRunsLeaveTheSameTrace) {
  hal::mujoco::MujocoMachine machine(request.machine.table);
  ASSERT_TRUE(run(&machine));
  const std::string first = test::content(folder / "out/trace.csv");
  ASSERT_TRUE(run(&machine));
  EXPECT_EQ(test::content(folder / "out/trace.csv"), first);
}

/// Asks for a stop at one write, and lets time pass from then on so that it is seen.
class Interrupted : public RunProgram {
 protected:
  Expected<RunResult> run_until(std::int64_t last_write) {
    request.program =
        test::text_of(folder.put("long.nc", "G01 X100 F3000\nG03 X150 Y50 R50\nG01 Y100\nX0 Y0\n"));
    request.stop = &stop;
    machine.on_write = [this, last_write](std::int64_t write) {
      if (write >= last_write) {
        stop = true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    };
    return run(&machine);
  }
  std::atomic<bool> stop{false};
  test::FakeMachine machine;
};

TEST_F(Interrupted, BrakesOnThePathAndKeepsAPartialTraceThatEndsAtRest) {
  const auto result = run_until(1500);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_EQ(result->failure->code, ErrorCode::kInterrupted);
  EXPECT_THAT(result->failure->message, HasSubstr("NC line 1"));
  EXPECT_FALSE(has("trace.csv"));
  ASSERT_TRUE(has("trace.partial.csv"));
  const test::TraceRows rows(folder / "out/trace.partial.csv");
  EXPECT_EQ(rows.last("feedrate_mm_per_s"), 0.0);
  EXPECT_EQ(rows.last("y_cmd_mm"), 0.0);
  EXPECT_LT(rows.last("x_cmd_mm"), 100.0);
  const auto x = rows.column("x_cmd_mm");
  ASSERT_GT(x.size(), 1000U);
  test::expect_within_limits(x, request.machine.period, request.machine.limits, 50.0);
  EXPECT_GE(machine.deactivations, 1);
}

TEST_F(Interrupted, FromTheStartNothingMoves) {
  stop = true;
  const auto result = run_until(1);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInterrupted);
  EXPECT_TRUE(machine.references.empty());
  EXPECT_EQ(machine.activations, 0);
  EXPECT_FALSE(has("trace.csv"));
}

TEST_F(RunProgram, MachineErrorEndsTheRunAndSwitchesOff) {
  test::FakeMachine machine;
  machine.read_that_fails = 800;
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_EQ(result->failure->code, ErrorCode::kMachine);
  EXPECT_THAT(result->failure->message, HasSubstr("alarm of drive X"));
  EXPECT_FALSE(has("trace.csv"));
  EXPECT_TRUE(has("trace.partial.csv"));
  EXPECT_EQ(machine.writes, 799);
  EXPECT_GE(machine.deactivations, 1);
  EXPECT_GE(machine.cleanups, 1);
}

TEST_F(RunProgram, MachineThatDoesNotStartIsSwitchedOffAndLeavesNoTrace) {
  test::FakeMachine machine;
  machine.fails_to_activate = true;
  const auto result = run(&machine);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "main power is off");
  EXPECT_EQ(machine.writes, 0);
  EXPECT_GE(machine.deactivations, 1);
  EXPECT_FALSE(has("trace.csv"));
  EXPECT_FALSE(has("trace.partial.csv"));
}

TEST_F(RunProgram, TravelIsCheckedBeforeTheMachineIsTouched) {
  request.program = test::text_of(folder.put("far.nc", "G01 X10 F600\nX201\n"));
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().line, 2);
  EXPECT_EQ(machine.activations, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_F(RunProgram, WhereAllIsCutCuttingTakesTheMachiningTime) {
  request.program = test::text_of(folder.put("cut.nc", "G1 X10 F600\nX0\n"));
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  EXPECT_DOUBLE_EQ(result->summary.cutting->time, result->summary.run->machining_time);
}

TEST_F(RunProgram, ThePenIsDownAtTheProgramsZeroWhateverTheToolsLength) {
  const auto cutting_time = [this](const std::string& before, double length) {
    request.program = test::text_of(
        folder.put("tool.nc", "G0 Z20\n" + before + "\nG0 Z3\nG1 Z0 F600\nX10\nG1 Z5\nX0\n"));
    test::FakeMachine machine;
    const auto result = run(&machine);
    EXPECT_TRUE(result) << to_string(result.error());
    EXPECT_EQ(result->summary.program_zero.at(result->summary.run->machining_time), length);
    return result->summary.cutting->time;
  };
  const double without = cutting_time("", 0.0);
  EXPECT_GT(without, 1.0);
  EXPECT_LT(without, 1.5);  // 10 mm at 10 mm/s, and not the way back above
  EXPECT_NEAR(cutting_time("G43.1 Z12", 12.0), without, 2e-3);
}

TEST_F(RunProgram, ProbingIsRefusedBeforeARealMachineIsTouched) {
  request.program = test::text_of(folder.put("probe.nc", "G0 X1\nG38.2 X5 F600\n"));
  test::FakeMachine machine;
  ASSERT_TRUE(run(&machine));
  EXPECT_EQ(machine.activations, 1);
  test::FakeMachine real;
  real.be_real();
  const auto result = run(&real);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().line, 2);
  EXPECT_NE(result.error().message.find("would not stop on this machine"), std::string::npos);
  EXPECT_EQ(real.activations, 0);
}

/// While it lives no file of this process grows beyond a size, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST_F(RunProgram, TraceThatCannotBeWrittenStopsTheMachineAtRest) {
  const FileSizeLimit full(100000);
  // Long enough for the trace's buffer to reach the disk while the machine moves.
  request.program = test::text_of(folder.put("long.nc", "G01 X150 F1500\nX0\n"));
  test::FakeMachine machine;
  machine.on_write = [](std::int64_t) { std::this_thread::yield(); };
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_EQ(result->failure->code, ErrorCode::kFile);
  EXPECT_THAT(result->failure->message, HasSubstr("cannot write"));
  EXPECT_FALSE(has("trace.csv"));
  const auto n = machine.references.size();
  EXPECT_LT((machine.references[n - 1] - machine.references[n - 2]).norm(), 1e-3);
}

}  // namespace run_test
}  // namespace twin::runtime

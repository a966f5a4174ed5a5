#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "tests/runtime/run_fixture.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/faulty_machine.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/trace_rows.hpp"

// What throws or trips in a run: the machine is off, the trace is kept, the run says why.
namespace twin::runtime {
namespace run_failures_test {

using ::testing::HasSubstr;

TEST_F(RunProgram, ProgressThatThrowsBrakesTheMachineAndKeepsTheTrace) {
  request.program = test::text_of(folder.put("long.nc", "G01 X100 F3000\nX0\nX100\nX0\n"));
  request.progress = [](double done) {
    if (done >= 0.5) {
      throw std::runtime_error("terminal is gone");
    }
  };
  test::FakeMachine machine;
  machine.on_write = [](std::int64_t) { std::this_thread::yield(); };
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_THAT(result->failure->message, HasSubstr("terminal is gone"));
  EXPECT_FALSE(has("trace.csv"));
  EXPECT_TRUE(has("trace.partial.csv"));
  const auto n = machine.references.size();
  EXPECT_LT((machine.references[n - 1] - machine.references[n - 2]).norm(), 1e-3);
  EXPECT_GE(machine.deactivations, 1);
}

TEST_F(RunProgram, PlannerThatThrowsBrakesTheMachine) {
  request.hooks.before_segment = [](std::int64_t n) {
    if (n == 2) {
      throw std::runtime_error("out of memory");
    }
  };
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_THAT(result->failure->message, HasSubstr("planning failed: out of memory"));
  EXPECT_GE(machine.deactivations, 1);
}

TEST_F(RunProgram, MotionThreadThatThrowsLeavesTheMachineOff) {
  request.is_wall_clock = true;
  request.machine.realtime.priority = 0;
  request.hooks.before_period = [](std::int64_t n) {
    if (n == 320) {
      throw std::runtime_error("unheard of");
    }
  };
  test::FakeMachine machine;
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_THAT(result->failure->message, HasSubstr("unheard of"));
  EXPECT_GE(machine.deactivations, 1);
  EXPECT_TRUE(has("trace.partial.csv"));
}

TEST_F(RunProgram, WallClockHasItsFiguresAndLockstepHasNone) {
  test::FakeMachine machine;
  const auto lockstep = run(&machine);
  ASSERT_TRUE(lockstep && !lockstep->failure);
  EXPECT_FALSE(lockstep->summary.run->realtime);
  EXPECT_FALSE(has("plots/timing.csv"));
  request.is_wall_clock = true;
  request.machine.realtime.max_late_periods = 1000000;  // however busy the computer is
  request.machine.realtime.max_stall = 100.0;
  const auto wall_clock = run(&machine);
  ASSERT_TRUE(wall_clock && !wall_clock->failure);
  ASSERT_TRUE(wall_clock->summary.run->realtime);
  const results::RealTimeStats& figures = *wall_clock->summary.run->realtime;
  EXPECT_LE(figures.wake_up.p50, figures.wake_up.p99);
  EXPECT_LE(figures.wake_up.p99, figures.wake_up.p999);
  EXPECT_LE(figures.wake_up.p999, figures.wake_up.max);
  EXPECT_GE(figures.total.max, figures.wake_up.max);
  EXPECT_GT(figures.compute.max, 0.0);
  EXPECT_TRUE(has("plots/timing.csv"));
  EXPECT_EQ(wall_clock->summary.run->machining_time, lockstep->summary.run->machining_time);
  ASSERT_TRUE(run(nullptr));
  EXPECT_FALSE(has("plots/timing.csv"));
}

TEST_F(RunProgram, TripIsTheFailureAndKeepsTheTrace) {
  test::FaultyMachine machine(request.machine.table);
  machine.on_read = [](std::int64_t n, hal::Inputs& inputs) { inputs.alarm[0] = n == 500; };
  const auto result = run(&machine);
  ASSERT_TRUE(result) << to_string(result.error());
  ASSERT_TRUE(result->failure);
  EXPECT_EQ(result->failure->code, ErrorCode::kMachine);
  EXPECT_EQ(result->failure->message,
            "axis x: drive alarm, at t = 0.199 s, NC line 1; 0 V and servo off at once; read the "
            "alarm on the drive and remove its cause");
  const test::TraceRows rows(folder / "out/trace.partial.csv");
  EXPECT_NEAR(rows.last("t_s"), 0.199, 1e-9);
  EXPECT_EQ(rows.last("x_drive_V"), 0.0);
}

}  // namespace run_failures_test
}  // namespace twin::runtime

#include <gtest/gtest.h>

#include "runtime/motion.hpp"
#include "tests/realtime/fake_clock.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/planned.hpp"
#include "tests/support/trace_rows.hpp"

// Motion on a wall clock that is late on purpose.
namespace twin::runtime {
namespace late_periods_test {

constexpr std::int64_t kMs = 1'000'000;  // [ns]

struct LatePeriods : public ::testing::Test {
  MotionResult run(const std::function<std::int64_t(std::int64_t)>& lateness = {}) {
    auto planned = test::plan_text("G01 X20 F3000\n");
    SegmentQueue segments(planned.size());
    for (feedrate::PlannedSegment& segment : planned) {
      segments.push(std::move(segment));
    }
    segments.close();
    motion::Interpolator interpolator(segments, 1e-3);
    Cycle cycle(interpolator, &machine, gains, 1e-3);
    clock.lateness = lateness;
    WallClockPace::Options options = pace;
    options.schedule = machine.info().keeps_own_time ? Schedule::kKept : Schedule::kShifted;
    WallClockPace wall_clock(segments, clock, options);
    return run_motion(cycle, interpolator, segments, samples, wall_clock,
                      {.rest_before = 0.01, .limits = limits}, stop);
  }

  /// Positions in X of all periods.
  std::vector<double> way() const {
    std::vector<double> x;
    for (const Vec3& p : machine.references) {
      x.push_back(p.x());
    }
    return x;
  }

  Limits limits;
  std::array<motion::Gains, hal::kServoAxes> gains{};
  test::FakeClock clock;
  test::FakeMachine machine;
  WallClockPace::Options pace;
  SampleQueue samples{100000};
  std::atomic<bool> stop{false};
};

TEST_F(LatePeriods, SetPointsTakeNoNoticeOfAFew) {
  ASSERT_EQ(run().end, MotionEnd::kDone);
  const auto on_time = way();
  machine.references.clear();
  std::int64_t stalls = 0;
  const MotionResult late = run([&](std::int64_t n) {
    stalls += n % 50 == 20 ? 1 : 0;
    return n % 50 == 20 ? 30 * kMs : 0;
  });
  EXPECT_EQ(late.end, MotionEnd::kDone);
  EXPECT_EQ(late.late_periods, stalls);
  EXPECT_GT(stalls, 5);
  EXPECT_NEAR(late.worst_latency, 0.03, 1e-9);
  EXPECT_EQ(way(), on_time);
}

TEST_F(LatePeriods, MachineWhoseTimeGoesOnIsSentWhereItShouldBeByNow) {
  ASSERT_EQ(run().end, MotionEnd::kDone);
  const std::vector<double> on_time = way();
  samples.reset();
  machine.references.clear();
  machine.keep_own_time();
  constexpr std::int64_t kLate = 100;  // sleep that ends 4.5 periods late
  const std::int64_t first = clock.sleeps;
  const MotionResult late =
      run([&](std::int64_t n) { return n - first == kLate ? 4 * kMs + kMs / 2 : 0; });
  EXPECT_EQ(late.end, MotionEnd::kDone);
  EXPECT_EQ(late.late_periods, 1);
  // Four set points were passed over; all others came at their time.
  std::vector<double> expected = on_time;
  expected.erase(expected.begin() + kLate, expected.begin() + kLate + 4);
  EXPECT_EQ(way(), expected);
  // The trace has a row for every one of them.
  results::Sample sample;
  std::int64_t rows = 0;
  std::int64_t passed_over = 0;
  while (samples.pop(sample)) {
    EXPECT_NEAR(sample.t, 1e-3 * static_cast<double>(rows++), 1e-9);
    passed_over += sample.is_passed_over ? 1 : 0;
  }
  EXPECT_EQ(passed_over, 4);
}

TEST_F(LatePeriods, SeveralInARowBrakeOnThePathAndEnd) {
  const MotionResult result = run([](std::int64_t n) { return n >= 150 ? 2 * kMs : 0; });
  ASSERT_EQ(result.end, MotionEnd::kTripped);
  EXPECT_EQ(result.trip->kind, motion::Kind::kLatePeriods);
  EXPECT_EQ(result.trip->value, pace.realtime.max_late_periods);
  EXPECT_EQ(result.trip->line, 1);
  const auto x = way();
  EXPECT_GT(x.back(), 1.0);
  EXPECT_LT(x.back(), 19.0);
  test::expect_within_limits(x, 1e-3, limits, 50.0, 0.1);
  EXPECT_EQ(machine.deactivations, 1);
}

TEST_F(LatePeriods, AStallBrakesOnThePathAndEnds) {
  const MotionResult result = run([](std::int64_t n) { return n == 150 ? 101 * kMs : 0; });
  ASSERT_EQ(result.end, MotionEnd::kTripped);
  EXPECT_EQ(result.trip->kind, motion::Kind::kStall);
  test::expect_within_limits(way(), 1e-3, limits, 50.0, 0.1);
}

TEST_F(LatePeriods, EveryPeriodReadsBeforeTheSetPointAndWritesLast) {
  std::int64_t most_ahead = 0;
  machine.on_write = [&](std::int64_t n) { most_ahead = std::max(most_ahead, machine.reads - n); };
  ASSERT_EQ(run().end, MotionEnd::kDone);
  EXPECT_EQ(most_ahead, 0);
}

TEST_F(LatePeriods, AHookIsCalledOnceAPeriod) {
  std::vector<std::int64_t> periods;
  pace.before_period = [&](std::int64_t n) { periods.push_back(n); };
  ASSERT_EQ(run().end, MotionEnd::kDone);
  ASSERT_EQ(periods.size(), static_cast<std::size_t>(clock.sleeps));
  EXPECT_EQ(periods.back(), clock.sleeps - 1);
}

TEST_F(LatePeriods, AHookThatThrowsLeavesTheMachineOff) {
  pace.before_period = [&](std::int64_t n) {
    if (n == 100) {
      throw std::runtime_error("no");
    }
  };
  EXPECT_THROW(run(), std::runtime_error);
  EXPECT_EQ(machine.deactivations, 1);
}

TEST_F(LatePeriods, SamplesHaveTheLatencyOfTheirPeriod) {
  ASSERT_EQ(run([](std::int64_t n) { return n % 2 == 0 ? kMs / 4 : 0; }).end, MotionEnd::kDone);
  results::Sample first;
  results::Sample second;
  ASSERT_TRUE(samples.pop(first) && samples.pop(second));
  EXPECT_NEAR(first.wake_up_latency + second.wake_up_latency, 0.00025, 1e-12);
  EXPECT_NEAR(first.total_time, first.wake_up_latency, 1e-12);
}

}  // namespace late_periods_test
}  // namespace twin::runtime

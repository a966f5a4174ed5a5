#include "runtime/cycle.hpp"

#include <gtest/gtest.h>

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/pacer.hpp"
#include "runtime/segment_queue.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/fake_machine.hpp"
#include "tests/support/planned.hpp"

namespace twin::runtime {
namespace cycle_test {

constexpr double kPeriod = 1e-3;  // [s]
constexpr char kProgram[] =
    "G01 X5 F3000\nG03 X10 Y5 R5\nG01 Y10.2\nY10.4\nX9.9 Y10.6\nX9.7 Y10.7\nX9.4 Y10.8\nX0\nY0\n";

/// A cycle over the segments of kProgram.
class CycleTest : public ::testing::Test {
 protected:
  CycleTest() {
    for (feedrate::PlannedSegment& segment : test::plan_text(kProgram)) {
      segments.push(std::move(segment));
    }
    segments.close();
  }

  SegmentQueue segments{100};
  motion::Interpolator interpolator{segments, kPeriod};
  std::array<motion::Gains, hal::kServoAxes> gains{};
  results::Sample sample;
};

TEST_F(CycleTest, AllocatesNothing) {
  hal::ideal::IdealMachine machine;
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  const std::int64_t before = test::allocations();
  bool is_fine = cycle.hold() == hal::Status::kOk;
  int periods = 0;
  while (cycle.prepare() == motion::Status::kMoving) {
    is_fine = is_fine && cycle.exchange(sample) == hal::Status::kOk;
    ++periods;
  }
  is_fine = is_fine && cycle.hold() == hal::Status::kOk;
  EXPECT_EQ(test::allocations(), before);
  EXPECT_TRUE(is_fine);
  EXPECT_GT(periods, 500);
}

TEST_F(CycleTest, SetPointOutsideTheTravelIsNeverSent) {
  hal::ideal::IdealMachine ideal;
  for (hal::Machine* const machine : std::initializer_list<hal::Machine*>{&ideal, nullptr}) {
    SegmentQueue queue{100};
    for (feedrate::PlannedSegment& segment : test::plan_text(kProgram)) {
      queue.push(std::move(segment));
    }
    queue.close();
    motion::Interpolator source{queue, kPeriod};
    if (machine != nullptr) {
      ASSERT_TRUE(checked(machine->configure(kPeriod)));
      ASSERT_TRUE(checked(machine->activate()));
    }
    Limits limits;
    limits.travel_max[0] = 5.0;
    Cycle cycle(source, machine, gains, kPeriod, {}, limits);
    double furthest = 0.0;
    bool is_fine = true;
    while (is_fine && cycle.prepare() == motion::Status::kMoving) {
      is_fine = cycle.exchange(sample) == hal::Status::kOk;
      furthest = std::max(furthest, sample.command.x());
    }
    EXPECT_FALSE(is_fine);
    EXPECT_LE(furthest, 5.05);
    EXPECT_GT(furthest, 4.9);
    ASSERT_TRUE(cycle.trip());
    EXPECT_EQ(cycle.trip()->kind, motion::Kind::kOutsideTravel);
    EXPECT_EQ(cycle.trip()->axis, 0U);
    EXPECT_GT(cycle.trip()->line, 0);
  }
}

TEST_F(CycleTest, AllocatesNothingWithMonitorsOnTheWallClock) {
  hal::mujoco::TableParams params;
  params.model = TWIN_SOURCE_DIR "/mjcf/xy_table.xml";
  hal::mujoco::MujocoMachine machine(params);
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  MonotonicClock clock;
  Pacer pacer(clock, 1e-5, {});
  const std::int64_t before = test::allocations();
  bool is_fine = true;
  int late = 0;
  for (int i = 0; i < 300; ++i) {
    const WakeUp wake_up = pacer.wait();
    late += pacer.overrun() ? 1 : 0;
    is_fine = is_fine && cycle.read(wake_up.interval) == hal::Status::kOk &&
              cycle.respond_at_rest() == hal::Status::kOk;
  }
  while (cycle.read(kPeriod) == hal::Status::kOk && cycle.prepare() == motion::Status::kMoving) {
    is_fine = is_fine && cycle.respond(sample) == hal::Status::kOk;
  }
  EXPECT_EQ(test::allocations(), before);
  EXPECT_TRUE(is_fine);
  EXPECT_FALSE(cycle.trip());
  EXPECT_GE(late, 0);
}

TEST_F(CycleTest, IdealMachineIsWhereTheCommandIs) {
  hal::ideal::IdealMachine machine;
  ASSERT_TRUE(checked(machine.configure(kPeriod)));
  ASSERT_TRUE(checked(machine.activate()));
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  std::int64_t periods = 0;
  while (cycle.prepare() == motion::Status::kMoving) {
    ASSERT_EQ(cycle.exchange(sample), hal::Status::kOk);
    ASSERT_EQ(sample.encoder, sample.command.head<2>());
    ASSERT_EQ(sample.table, sample.command.head<2>());
    ASSERT_NEAR(sample.t, static_cast<double>(periods++) * kPeriod, 1e-12);
  }
  EXPECT_LT(sample.command.norm(), 1e-9);
}

TEST_F(CycleTest, WithoutAMachineOnlyTheCommandIsRecorded) {
  Cycle cycle(interpolator, nullptr, gains, kPeriod);
  ASSERT_EQ(cycle.prepare(), motion::Status::kMoving);
  ASSERT_EQ(cycle.exchange(sample), hal::Status::kOk);
  EXPECT_EQ(sample.t, 0.0);
  EXPECT_EQ(sample.command, Vec3(0.0, 0.0, 0.0));
  EXPECT_EQ(sample.feedrate, 0.0);
  EXPECT_EQ(sample.line, 1);
}

TEST_F(CycleTest, VoltsAreTheFeedforwardOfTheIdealMachinesSpeed) {
  gains[hal::kX].kf = 1.0;
  test::FakeMachine machine;  // reads zero counts; 100 mm/s per volt
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  for (int i = 0; i < 75; ++i) {
    ASSERT_EQ(cycle.prepare(), motion::Status::kMoving);
    ASSERT_EQ(cycle.exchange(sample), hal::Status::kOk);
  }
  ASSERT_EQ(sample.feedrate, 50.0);
  const double position_part = gains[hal::kX].kp * sample.command.x() / 100.0;
  EXPECT_NEAR(sample.volts.x() - position_part, 0.5, 1e-9);
}

TEST_F(CycleTest, HoldStaysOnThePlaceAndTakesNoTime) {
  test::FakeMachine machine;
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  for (int i = 0; i < 50; ++i) {
    ASSERT_EQ(cycle.prepare(), motion::Status::kMoving);
    ASSERT_EQ(cycle.exchange(sample), hal::Status::kOk);
  }
  const results::Sample before = sample;
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(cycle.hold(), hal::Status::kOk);
    EXPECT_EQ(machine.references.back(), before.command);
  }
  ASSERT_EQ(cycle.prepare(), motion::Status::kMoving);
  ASSERT_EQ(cycle.exchange(sample), hal::Status::kOk);
  EXPECT_NEAR(sample.t - before.t, kPeriod, 1e-12);
}

TEST_F(CycleTest, SaysSoWhenTheMachineCannotBeRead) {
  test::FakeMachine machine;
  machine.read_that_fails = 2;
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  cycle.prepare();
  EXPECT_EQ(cycle.exchange(sample), hal::Status::kOk);
  EXPECT_EQ(cycle.exchange(sample), hal::Status::kError);
  EXPECT_EQ(cycle.hold(), hal::Status::kError);
  EXPECT_EQ(machine.writes, 1);
}

TEST_F(CycleTest, SaysSoWhenTheMachineCannotBeWritten) {
  test::FakeMachine machine;
  machine.write_that_fails = 1;
  Cycle cycle(interpolator, &machine, gains, kPeriod);
  cycle.prepare();
  EXPECT_EQ(cycle.exchange(sample), hal::Status::kError);
}

}  // namespace cycle_test
}  // namespace twin::runtime

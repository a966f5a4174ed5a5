#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "config/machine_file.hpp"
#include "runtime/motion.hpp"
#include "tests/support/faulty_machine.hpp"
#include "tests/support/planned.hpp"

// Faults put between controller and simulated table: what trips, how soon, and how far the table
// has gone by then. In every case 0 V and servo off are written in the period of the trip, and
// nothing after it.
namespace twin::runtime {
namespace faults_test {

constexpr double kPeriod = 0.001;  // [s]
constexpr std::size_t kSamples = 100000;

/// The table under a program, with a fault.
class Faults : public ::testing::Test {
 protected:
  Faults() : file(*config::read_machine_file(TWIN_SOURCE_DIR "/mjcf/xy_table.toml")) {}

  MotionResult run(const std::string& program = "G01 X40 F3000\nX0\n") {
    EXPECT_TRUE(checked(machine.configure(kPeriod)));
    EXPECT_TRUE(checked(machine.activate()));
    test::InlinePlan plan(program, file);
    motion::Interpolator interpolator(plan.planning, kPeriod);
    Cycle cycle(interpolator, &machine, file.servo, kPeriod, file.safety, file.limits);
    LockstepPace pace(plan.planning, stop);
    return run_motion(cycle, interpolator, plan.planning, samples, pace,
                      {.ready_timeout = file.safety.ready_timeout, .limits = file.limits}, stop);
  }

  /// It ended with this, and the machine was switched off in the same period.
  void expect_off(const MotionResult& result, motion::Kind kind, std::size_t axis) {
    ASSERT_EQ(result.end, MotionEnd::kTripped);
    EXPECT_EQ(result.trip->kind, kind) << describe(*result.trip);
    EXPECT_EQ(result.trip->axis, axis);
    EXPECT_TRUE(is_immediate(*result.trip));
    EXPECT_EQ(machine.last_written.volts[0], 0.0);
    EXPECT_EQ(machine.last_written.volts[1], 0.0);
    EXPECT_FALSE(machine.last_written.servo_on[0]);
    EXPECT_FALSE(machine.last_written.servo_on[1]);
    EXPECT_EQ(machine.writes, machine.reads);
    EXPECT_EQ(machine.writes_after_off, 0);
    EXPECT_TRUE(machine.is_off);
  }

  /// Changes the inputs from one read on.
  void from_read(std::int64_t first, const std::function<void(hal::Inputs&)>& change) {
    machine.on_read = [=](std::int64_t n, hal::Inputs& inputs) {
      if (n >= first) {
        change(inputs);
      }
    };
  }

  config::MachineFile file;
  test::FaultyMachine machine{file.table};
  SampleQueue samples{kSamples};
  std::atomic<bool> stop{false};
};

TEST_F(Faults, WithoutAnyTheRunIsDoneAndTheMachineIsOff) {
  const MotionResult result = run();
  EXPECT_EQ(result.end, MotionEnd::kDone);
  EXPECT_FALSE(result.trip);
  EXPECT_TRUE(machine.is_off);
}

TEST_F(Faults, DriveAlarmSwitchesOffInItsPeriod) {
  from_read(500, [](hal::Inputs& inputs) { inputs.alarm[1] = true; });
  const MotionResult result = run();
  expect_off(result, motion::Kind::kDriveAlarm, 1);
  EXPECT_EQ(machine.reads, 500);
  // 300 periods of settling come before the first set point.
  EXPECT_NEAR(result.trip->time, 0.199, 1e-9);
  EXPECT_EQ(result.trip->line, 1);
  // The period of the trip is the last one recorded.
  EXPECT_EQ(samples.size(), 200U);
}

TEST_F(Faults, ReadyThatGoesSwitchesOffInItsPeriod) {
  from_read(500, [](hal::Inputs& inputs) { inputs.servo_ready[0] = false; });
  expect_off(run(), motion::Kind::kReadyLost, 0);
  EXPECT_EQ(machine.reads, 500);
}

TEST_F(Faults, LimitSwitchSwitchesOffInItsPeriod) {
  from_read(500, [](hal::Inputs& inputs) { inputs.limit_positive[0] = true; });
  expect_off(run(), motion::Kind::kPositiveLimit, 0);
  EXPECT_EQ(machine.reads, 500);
}

TEST_F(Faults, LostCounterSwitchesOffInItsPeriod) {
  from_read(600, [](hal::Inputs& inputs) { inputs.counts[0] = 0; });
  expect_off(run(), motion::Kind::kCountStep, 0);
  EXPECT_EQ(machine.reads, 600);
}

TEST_F(Faults, FrozenEncoderIsFoundWithinMillimetres) {
  std::int64_t frozen = 0;
  machine.on_read = [&](std::int64_t n, hal::Inputs& inputs) {
    frozen = n < 600 ? inputs.counts[0] : frozen;
    inputs.counts[0] = frozen;
  };
  expect_off(run(), motion::Kind::kEncoderFrozen, 0);
  EXPECT_LE(machine.reads, 610);
}

TEST_F(Faults, AlarmBeforeTheFirstSetPointLetsNothingMove) {
  from_read(100, [](hal::Inputs& inputs) { inputs.alarm[0] = true; });
  const MotionResult result = run();
  expect_off(result, motion::Kind::kDriveAlarm, 0);
  EXPECT_EQ(result.trip->line, 0);
  EXPECT_EQ(samples.size(), 0U);
}

TEST_F(Faults, DriveThatIsNeverReadyLetsNothingMove) {
  file.safety.ready_timeout = 0.5;
  from_read(1, [](hal::Inputs& inputs) { inputs.servo_ready[1] = false; });
  const MotionResult result = run();
  ASSERT_EQ(result.end, MotionEnd::kTripped);
  EXPECT_EQ(result.trip->kind, motion::Kind::kNotReady);
  EXPECT_EQ(result.trip->axis, 1U);
  EXPECT_EQ(machine.reads, 500);
  EXPECT_EQ(samples.size(), 0U);
  EXPECT_TRUE(machine.is_off);
  EXPECT_EQ(machine.last_written.position_reference[0], 0.0);
}

TEST_F(Faults, LateReadyHoldsThePathBackForAnotherSettling) {
  machine.on_read = [](std::int64_t n, hal::Inputs& inputs) {
    inputs.servo_ready[0] = inputs.servo_ready[0] && n > 1000;
  };
  std::int64_t first_motion = 0;
  machine.on_write = [&](std::int64_t n, hal::Outputs& outputs) {
    first_motion = first_motion == 0 && outputs.position_reference[0] > 0.0 ? n : first_motion;
  };
  EXPECT_EQ(run().end, MotionEnd::kDone);
  EXPECT_GT(first_motion, 1300);
  EXPECT_LT(first_motion, 1320);
}

TEST_F(Faults, SaturatedDriveCommandBrakesOnThePath) {
  // A trim beyond 10 V cuts every drive command; the converter is stuck at 0 V.
  file.safety.saturation_time = 0.005;
  file.safety.tracking_error = 100.0;
  file.servo[0].trim_V = 20.0;
  machine.on_write = [](std::int64_t, hal::Outputs& outputs) { outputs.volts[0] = 0.0; };
  const MotionResult result = run();
  ASSERT_EQ(result.end, MotionEnd::kTripped);
  EXPECT_EQ(result.trip->kind, motion::Kind::kSaturation);
  EXPECT_FALSE(is_immediate(*result.trip));
}

/// A wrong sign of one wire from one period on, or from the start.
struct WrongSign {
  std::size_t axis;
  bool is_encoder;     // else V-REF
  std::int64_t first;  // period
};

class Runaways : public Faults, public ::testing::WithParamInterface<WrongSign> {};

TEST_P(Runaways, TripWithin20MillisecondsAndHalfAMillimetre) {
  const auto [axis, is_encoder, first] = GetParam();
  std::int64_t turned_at = 0;  // counts at the turn
  std::int64_t diverges = 0;   // write at which the error leaves what a sound table shows
  double largest_error = 0.0;  // true position from the set point [mm]
  if (is_encoder) {
    machine.on_read = [&, axis = axis, first = first](std::int64_t n, hal::Inputs& inputs) {
      turned_at = n < first ? inputs.counts[axis] : turned_at;
      inputs.counts[axis] = n < first ? turned_at : 2 * turned_at - inputs.counts[axis];
    };
  }
  machine.on_write = [&, axis = axis, is_encoder = is_encoder, first = first](
                         std::int64_t n, hal::Outputs& outputs) {
    const double error =
        std::abs(outputs.position_reference[axis] - machine.truth().table_position[axis]);
    if (n >= first) {
      largest_error = std::max(largest_error, error);
      diverges = diverges == 0 && error > 0.03 ? n : diverges;
      outputs.volts[axis] *= is_encoder ? 1.0 : -1.0;
    }
  };
  const MotionResult result = run(axis == 0 ? "G01 X40 F3000\nX0\n" : "G01 Y40 F3000\nY0\n");
  expect_off(result, motion::Kind::kRunaway, axis);
  EXPECT_LE(largest_error, 0.5);
  if (diverges > 0) {
    EXPECT_LE(static_cast<double>(machine.writes - diverges) * kPeriod, 0.020);
  }
}

// From the start, at rest, while it speeds up, at 50 mm/s, while it slows down, on the way back.
INSTANTIATE_TEST_SUITE_P(Signs, Runaways, ::testing::ValuesIn([] {
                           std::vector<WrongSign> all;
                           for (const std::size_t axis : {0U, 1U}) {
                             for (const bool is_encoder : {true, false}) {
                               for (const std::int64_t first : {1, 200, 310, 600, 1150, 1700}) {
                                 all.push_back({axis, is_encoder, first});
                               }
                             }
                           }
                           return all;
                         }()),
                         [](const auto& instance) {
                           return fmt::format("{}{}From{}", "XY"[instance.param.axis],
                                              instance.param.is_encoder ? "Encoder" : "Vref",
                                              instance.param.first);
                         });

}  // namespace faults_test
}  // namespace twin::runtime

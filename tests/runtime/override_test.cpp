#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/runtime/override_run.hpp"

// Feed override and hold in simulated time: the set points keep every limit and the path, whatever
// the schedule.
namespace twin::runtime {
namespace override_test {

using test::expect_same_path_within_limits;
using test::OverrideRun;
using test::run_with_overrides;
using Schedule = std::vector<OverrideChange>;

config::MachineFile machine_of(Planner planner) {
  config::MachineFile machine;
  machine.path.planner = planner;
  return machine;
}

/// A wave of short blocks, a corner, an arc, a dwell, a helix, an exact stop and rapids.
std::string mixed_program() {
  std::string text = "G01 F3000\n";
  for (int i = 1; i <= 120; ++i) {
    text += fmt::format("X{:.4f} Y{:.4f}\n", 0.25 * i, 2.0 * std::sin(0.4 * i) * std::sin(0.1 * i));
  }
  return text +
         "X40\nY12\nG03 X30 Y22 R10\nG04 P0.15\nG02 X26 Y18 R4 Z2\nG01 X10\nG61\nX5 Y10\nG64\n"
         "Y2\nG00 X0 Y-5 Z0\nG01 X3 Y-5 F1500\nX3.02\nX3.04 Y-5.01\nX6\n";
}

const test::PlainRun& plain_run(Planner planner) {
  static const auto paper = test::run_plain(mixed_program(), machine_of(Planner::kPaper));
  static const auto certified = test::run_plain(mixed_program(), machine_of(Planner::kCertified));
  return planner == Planner::kPaper ? paper : certified;
}

class Override : public ::testing::TestWithParam<Planner> {
 protected:
  OverrideRun run(const Schedule& schedule) const {
    return run_with_overrides(mixed_program(), machine, schedule);
  }
  void expect_sound(const Schedule& schedule) const {
    expect_same_path_within_limits(run(schedule), plain_run(GetParam()), machine);
  }
  config::MachineFile machine = machine_of(GetParam());
};

TEST_P(Override, HalvesAndDoublesTheFeedrateOnALongLine) {
  const auto line = run_with_overrides("G01 X100 F2400\n", machine, {{0.5, 50.0}, {1.5, 200.0}});
  const auto feedrate = [&](double t) {
    return line.samples[static_cast<std::size_t>(std::lround(t / machine.period))].feedrate;
  };
  EXPECT_NEAR(feedrate(0.45), 40.0, 1e-9);
  EXPECT_NEAR(feedrate(0.7), 20.0, 1e-9);
  EXPECT_NEAR(feedrate(1.45), 20.0, 1e-9);
  EXPECT_NEAR(feedrate(1.7), 80.0, 1e-9);
  ASSERT_EQ(line.records.size(), 2U);
  EXPECT_GE(line.records[0].from, 0.5);
  EXPECT_LE(line.records[0].from, 0.53);
}

TEST_P(Override, ARapidIsNeverFasterThanItsOwnFeedrate) {
  const auto rapid = run_with_overrides("G00 X100\n", machine, {{0.0, 200.0}});
  double peak = 0.0;
  for (const results::Sample& sample : rapid.samples) {
    peak = std::max(peak, sample.feedrate);
  }
  EXPECT_NEAR(peak, machine.limits.rapid_feedrate, 1e-9);
}

TEST_P(Override, BeforeTheFirstMotionHoldsOrScalesAllOfIt) {
  expect_sound({{0.0, 50.0}});
  const auto held = run({{0.0, 0.0}, {0.4, 100.0}});
  expect_same_path_within_limits(held, plain_run(GetParam()), machine);
  EXPECT_EQ(held.samples[399].command, held.samples[0].command);
  EXPECT_NEAR(held.samples.back().t, plain_run(GetParam()).run.samples.back().t + 0.4, 2e-3);
}

TEST_P(Override, HoldFromAnyInstantGoesOnAlongTheSamePath) {
  const double end = plain_run(GetParam()).run.samples.back().t;
  for (double t = 0.003; t < end; t += 0.0773) {
    SCOPED_TRACE(t);
    expect_sound({{t, 0.0}, {t + 0.25, 100.0}});
    if (HasFatalFailure()) {
      return;
    }
  }
}

TEST_P(Override, JumpsToTheHighestAndNearThePathsEndAreSound) {
  const double end = plain_run(GetParam()).run.samples.back().t;
  expect_sound({{0.2, 0.0}, {0.5, 200.0}});
  for (double before = 0.001; before < 0.2; before += 0.011) {
    SCOPED_TRACE(before);
    expect_sound({{end - before, 30.0}});
    expect_sound({{end - before, 0.0}, {end + 0.3, 200.0}});
  }
}

TEST_P(Override, RandomSchedulesKeepTheLimitsAndThePath) {
  for (unsigned seed = 1; seed <= 25; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform;
    const double gap = seed % 3 == 0 ? 0.02 : 0.4;  // some change more often than a plan can follow
    Schedule schedule;
    double t = 0.0;
    while (t < 5.0) {
      t += 1e-4 + gap * uniform(random);
      schedule.push_back({t, uniform(random) < 0.2 ? 0.0 : 1.0 + 199.0 * uniform(random)});
    }
    schedule.push_back({t + 0.5, 100.0});
    SCOPED_TRACE(seed);
    expect_sound(schedule);
    if (HasFatalFailure()) {
      return;
    }
  }
}

TEST_P(Override, TheSameScheduleGivesTheSameSetPoints) {
  const Schedule schedule{{0.3, 40.0}, {0.5, 170.0}, {0.9, 0.0}, {1.2, 80.0}, {1.21, 90.0}};
  const auto first = run(schedule);
  const auto second = run(schedule);
  ASSERT_EQ(first.samples.size(), second.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i) {
    ASSERT_EQ(first.samples[i].command, second.samples[i].command) << i;
    ASSERT_EQ(first.samples[i].segment, second.samples[i].segment) << i;
  }
}

TEST(OverrideOfEachAxis, KeepsTheLimitsOfEachAxis) {
  config::MachineFile machine = machine_of(Planner::kCertified);
  machine.limits.axis_acceleration = {900.0, 700.0, 900.0};
  machine.limits.axis_jerk = {40000.0, 30000.0, 40000.0};
  std::string text = "G01 F3000\n";
  for (int i = 1; i <= 240; ++i) {
    text += fmt::format("X{:.6f} Y{:.6f}\n", 0.25 * i, 2.0 * std::sin(0.0625 * i));
  }
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform;
    Schedule schedule;
    for (double t = 0.05; seed > 0 && t < 2.5; t += 0.02 + 0.3 * uniform(random)) {
      schedule.push_back({t, uniform(random) < 0.2 ? 0.0 : 1.0 + 199.0 * uniform(random)});
    }
    schedule.push_back({4.0, 100.0});
    const auto run = run_with_overrides(text, machine, schedule);
    results::LimitAudit audit(machine.period, machine.limits);
    for (const results::Sample& sample : run.samples) {
      audit.add(sample.command);
    }
    const auto peaks = audit.finish();
    for (const std::size_t axis : {0U, 1U}) {
      const auto k = static_cast<Eigen::Index>(axis);
      EXPECT_LE(peaks.axis[axis].acceleration, 1.005 * machine.limits.axis_acceleration[k]) << seed;
      EXPECT_LE(peaks.axis[axis].jerk, 1.005 * machine.limits.axis_jerk[k]) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Planners, Override,
                         ::testing::Values(Planner::kPaper, Planner::kCertified),
                         [](const auto& which) {
                           return which.param == Planner::kPaper ? "Paper" : "Certified";
                         });

}  // namespace override_test
}  // namespace twin::runtime

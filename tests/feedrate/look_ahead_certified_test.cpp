#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "path/smooth_builder.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/motion_profile.hpp"
#include "tests/support/plan.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace look_ahead_certified_test {

using test::expect_whole;
using test::line_block;
using test::plan;
using test::PlanSettings;
using test::random_program;

PlanSettings certified() {
  PlanSettings settings;
  settings.path.planner = Planner::kCertified;
  return settings;
}

TEST(LookAheadCertified, RandomProgramsArePlannedWholeAndNoSlowerThanByThePaper) {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    const auto segments = test::build(random_program(random, 25));
    const auto planned = plan(segments, certified());
    ASSERT_EQ(planned.segments.size(), segments.size());
    ASSERT_NO_FATAL_FAILURE(expect_whole(planned, {})) << "program " << i;
    EXPECT_EQ(planned.fallbacks, 0) << "program " << i;
    EXPECT_LE(planned.time, plan(segments).time * 1.002) << "program " << i;
  }
}

TEST(LookAheadCertified, RandomProgramsArePlannedWholeWithinOtherLimits) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto blocks = random_program(random, 25);
    for (const auto& [acceleration, jerk] :
         {std::pair{300.0, 2e3}, {2e4, 1e6}, {500.0, 1e6}, {2450.0, 1e9}, {1e6, 1e3}, {5.0, 5.0}}) {
      PlanSettings settings = certified();
      settings.limits.acceleration = acceleration;
      settings.limits.jerk = jerk;
      const auto planned = plan(blocks, settings);
      ASSERT_NO_FATAL_FAILURE(expect_whole(planned, settings.limits))
          << "program " << i << " a " << acceleration << " j " << jerk;
      EXPECT_EQ(planned.fallbacks, 0) << "program " << i << " a " << acceleration << " j " << jerk;
    }
  }
}

/// Beyond this a path is slower: what the method loses by following closed forms.
constexpr double kSlower = 1.001;

TEST(LookAheadCertified, AHigherLimitNeverMakesAPathSlower) {
  std::mt19937 random(6);
  for (int i = 0; i < 40; ++i) {
    const auto blocks = random_program(random, 20);
    const PlanSettings least = certified();
    double acceleration = least.limits.acceleration;
    double jerk = 0.1 * least.limits.jerk;
    double before_a = std::numeric_limits<double>::infinity();
    double before_j = before_a;
    for (int k = 0; k < 5; ++k) {
      PlanSettings settings = least;
      settings.limits.acceleration = acceleration;
      const double time_a = plan(blocks, settings).time;
      EXPECT_LE(time_a, before_a * kSlower) << "program " << i << " a " << acceleration;
      settings = least;
      settings.limits.jerk = jerk;
      const double time_j = plan(blocks, settings).time;
      EXPECT_LE(time_j, before_j * kSlower) << "program " << i << " j " << jerk;
      before_a = time_a;
      before_j = time_j;
      acceleration *= 1.4;
      jerk *= 1.8;
    }
  }
}

// J T / A from 0.16 to 9: bends lose feedrate where the acceleration can swing within a period.
TEST(LookAheadCertified, AJerkThatReachesTheAccelerationWithinAPeriodMakesNoPathSlower) {
  std::mt19937 random(8);
  for (int i = 0; i < 40; ++i) {
    const auto blocks = random_program(random, 20);
    double before = std::numeric_limits<double>::infinity();
    for (double jerk = 4e5; jerk < 2e7; jerk *= 1.5) {
      PlanSettings settings = certified();
      settings.limits.jerk = jerk;
      const double time = plan(blocks, settings).time;
      EXPECT_LE(time, before * kSlower) << "program " << i << " j " << jerk;
      before = time;
    }
  }
}

TEST(LookAheadCertified, AHigherFeedrateNeverMakesAPathSlower) {
  std::mt19937 random(7);
  for (int i = 0; i < 100; ++i) {
    PlanSettings settings = certified();
    settings.limits.feedrate = 1000.0;
    std::vector<path::Segment> segments;
    path::SmoothBuilder builder(
        settings.path, settings.model, settings.limits,
        [&](path::Segment&& segment) { segments.push_back(std::move(segment)); });
    for (const gcode::Block& block : random_program(random, 20)) {
      builder.push(block);
    }
    builder.finish();
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 12; ++k) {
      const double time = plan(segments, settings).time;
      EXPECT_LE(time, before * kSlower) << "program " << i << " scaled " << k << " times";
      before = time;
      for (path::Segment& segment : segments) {
        segment.feedrate *= 1.35;
      }
    }
  }
}

// The circle of Eqs. 2 to 6: at 297 mm/s its normal acceleration reaches A.
TEST(LookAheadCertified, ACircleIsNoSlowerBeyondTheFeedrateAtWhichItIsCritical) {
  PlanSettings settings = certified();
  settings.limits.feedrate = 1000.0;
  const auto time_at = [&](double feedrate) {
    return plan({test::arc_block({0, 0, 0}, {1, 0, 0}, 36.0, 2.0 * std::numbers::pi, true,
                                 feedrate)},
                settings)
        .time;
  };
  EXPECT_LE(time_at(300.0), time_at(17800.0 / 60.0) * kSlower);
  EXPECT_NEAR(time_at(300.0), 0.932, 0.001);
}

TEST(LookAheadCertified, ALineTakesAsLongInAnyNumberOfPieces) {
  for (const double feedrate : {0.1, 50.0, 200.0}) {
    const double length = std::min(100.0, 20.0 * feedrate);
    const double uncut = plan({line_block({0, 0, 0}, {length, 0, 0}, feedrate)}, certified()).time;
    for (const int count : {10, 2000, 20000}) {
      std::vector<path::Segment> lines;
      for (int i = 0; i < count; ++i) {
        const double step = length / count;
        lines.push_back(path::make_segment(
            line_block({step * i, 0, 0}, {step * (i + 1), 0, 0}, feedrate), 0, {}, {}));
      }
      const auto planned = plan(lines, certified());
      EXPECT_NEAR(planned.time, uncut, 1e-4) << feedrate << " mm/s in " << count;
      EXPECT_EQ(planned.fallbacks, 0) << feedrate << " mm/s in " << count;
    }
  }
}

}  // namespace look_ahead_certified_test
}  // namespace twin::feedrate

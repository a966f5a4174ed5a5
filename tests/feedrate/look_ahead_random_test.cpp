#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/motion_profile.hpp"
#include "tests/support/plan.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace look_ahead_random_test {

using test::expect_whole;
using test::plan;
using test::PlanSettings;
using test::random_program;

TEST(LookAheadRandom, ProgramsArePlannedWholeWithoutFallbackWhateverTheWindow) {
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    const auto segments = test::build(random_program(random, 25));
    for (const int window : {2, 10, 200}) {
      PlanSettings settings;
      settings.look_ahead = window;
      const auto planned = plan(segments, settings);
      ASSERT_EQ(planned.segments.size(), segments.size());
      ASSERT_NO_FATAL_FAILURE(expect_whole(planned, settings.limits))
          << "program " << i << " window " << window;
      EXPECT_EQ(planned.fallbacks, 0) << "program " << i << " window " << window;
    }
  }
}

TEST(LookAheadRandom, ProgramsArePlannedWholeAtAnyPeriod) {
  std::mt19937 random(2);
  for (int i = 0; i < 200; ++i) {
    const auto segments = test::build(random_program(random, 25));
    for (const double period : {0.125e-3, 0.5e-3, 4e-3}) {
      PlanSettings settings;
      settings.look_ahead = 20;
      settings.period = period;
      const auto planned = plan(segments, settings);
      ASSERT_NO_FATAL_FAILURE(expect_whole(planned, settings.limits))
          << "program " << i << " period " << period;
      EXPECT_EQ(planned.fallbacks, 0) << "program " << i << " period " << period;
    }
  }
}

TEST(LookAheadRandom, ProgramsArePlannedWholeWithinOtherLimits) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto blocks = random_program(random, 25);
    for (const auto& [acceleration, jerk] : {std::pair{300.0, 2e3}, {2e4, 1e6}, {500.0, 1e6}}) {
      PlanSettings settings;
      settings.limits.acceleration = acceleration;
      settings.limits.jerk = jerk;
      const auto planned = plan(blocks, settings);
      ASSERT_NO_FATAL_FAILURE(expect_whole(planned, settings.limits))
          << "program " << i << " a " << acceleration;
      EXPECT_EQ(planned.fallbacks, 0) << "program " << i << " a " << acceleration;
    }
  }
}

TEST(LookAheadRandom, AShortWindowCostsLittleTime) {
  std::mt19937 random(4);
  double sum = 0.0;
  double sum_short = 0.0;
  for (int i = 0; i < 200; ++i) {
    const auto segments = test::build(random_program(random, 25));
    PlanSettings settings;
    settings.look_ahead = 1000000;
    const double endless = plan(segments, settings).time;
    settings.look_ahead = 200;
    EXPECT_NEAR(plan(segments, settings).time, endless, 0.001 * endless) << "program " << i;
    settings.look_ahead = 2;
    sum += endless;
    sum_short += plan(segments, settings).time;
  }
  EXPECT_LE(sum_short, 1.001 * sum);
}

TEST(LookAheadRandom, NoPlanIsFasterThanAccelerationAloneAllows) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const auto planned = plan(random_program(random, 25));
    std::vector<LimitZone> zones;
    double begin = 0.0;
    double rests = 0.0;
    for (const PlannedSegment& segment : planned.segments) {
      for (const LimitZone& zone : segment.limits) {
        zones.push_back({begin + zone.begin, begin + zone.end, zone.limit});
      }
      begin += segment.segment.length;
      rests += segment.segment.dwell;
    }
    const double bound = test::acceleration_bound(zones, 0.0, 0.0, Limits{}.acceleration, 3000);
    EXPECT_GE(planned.time - rests, bound) << "program " << i;
  }
}

}  // namespace look_ahead_random_test
}  // namespace twin::feedrate

#include <gtest/gtest.h>

#include "feedrate/look_ahead.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace look_ahead_start_test {

using test::build;
using test::line_block;

constexpr double kTau50 = 0.0632455532033676;  // 2 sqrt(50 / 50000), ramp between 0 and 50 mm/s [s]

double time_with(Planner planner, const std::vector<gcode::Block>& blocks, LookAhead::Start start,
                 double scale, std::vector<Phase>* phases) {
  double time = 0.0;
  const auto sink = [&](PlannedSegment&& planned) {
    for (const Phase& phase : planned.phases) {
      time += phase.duration;
      if (phases != nullptr) {
        phases->push_back(phase);
      }
    }
  };
  PathSettings path;
  path.planner = planner;
  LookAhead look_ahead({}, {}, path, 1e-3, sink, start, scale);
  for (path::Segment& segment : build(blocks)) {
    look_ahead.push(std::move(segment));
  }
  look_ahead.finish();
  EXPECT_EQ(look_ahead.fallbacks(), 0);
  return time;
}

/// By both planners, which agree on lines.
double time_of(const std::vector<gcode::Block>& blocks, LookAhead::Start start, double scale,
               std::vector<Phase>* phases = nullptr) {
  const double time = time_with(Planner::kPaper, blocks, start, scale, phases);
  EXPECT_NEAR(time_with(Planner::kCertified, blocks, start, scale, nullptr), time, 1e-8);
  return time;
}

TEST(LookAheadStart, InMotionOnlyTheRampToRestIsLost) {
  std::vector<Phase> phases;
  const double time = time_of({line_block({0, 0, 0}, {60, 0, 0})}, {20.0, 50.0}, 1.0, &phases);
  EXPECT_NEAR(time, 40.0 / 50.0 + 0.5 * kTau50, 1e-9);
  EXPECT_EQ(phases.front().s, 20.0);
  EXPECT_EQ(phases.front().v, 50.0);
}

TEST(LookAheadStart, ScaleHalvesTheProgrammedFeedrate) {
  const double tau = 2.0 * std::sqrt(25.0 / 50000.0);
  EXPECT_NEAR(time_of({line_block({0, 0, 0}, {60, 0, 0})}, {0.0, 0.0}, 0.5), 60.0 / 25.0 + tau,
              1e-9);
}

TEST(LookAheadStart, ComesDownAtOnceWhereItIsFasterThanTheScaledFeedrate) {
  // The ramp from 50 to 25 mm/s has the mean 37.5, the one to rest 12.5.
  const double tau = 2.0 * std::sqrt(25.0 / 50000.0);
  const double time = time_of({line_block({0, 0, 0}, {60, 0, 0})}, {10.0, 50.0}, 0.5);
  EXPECT_NEAR(time, 2.0 * tau + (50.0 - (37.5 + 12.5) * tau) / 25.0, 1e-9);
}

TEST(LookAheadStart, ComesDownAcrossTheBorderOfTwoSegments) {
  const double tau = 2.0 * std::sqrt(25.0 / 50000.0);
  const double time = time_of(
      {line_block({0, 0, 0}, {20, 0, 0}), line_block({20, 0, 0}, {60, 0, 0})}, {19.9, 50.0}, 0.5);
  EXPECT_NEAR(time, 2.0 * tau + (40.1 - (37.5 + 12.5) * tau) / 25.0, 1e-9);
}

TEST(LookAheadStart, RapidsTakeNoMoreThanTheirOwnFeedrate) {
  gcode::Block rapid = line_block({0, 0, 0}, {90, 0, 0}, 50.0);
  rapid.motion = gcode::Motion::kRapid;
  const double whole = time_of({rapid}, {0.0, 0.0}, 1.0);
  EXPECT_EQ(time_of({rapid}, {0.0, 0.0}, 2.0), whole);
  EXPECT_GT(time_of({rapid}, {0.0, 0.0}, 0.5), 1.5 * whole);
}

TEST(LookAheadStart, NoScaleExceedsTheMachinesFeedrate) {
  const std::vector<gcode::Block> fast{line_block({0, 0, 0}, {190, 0, 0}, 150.0)};
  const std::vector<gcode::Block> fastest{line_block({0, 0, 0}, {190, 0, 0}, 200.0)};
  EXPECT_EQ(time_of(fast, {0.0, 0.0}, 2.0), time_of(fastest, {0.0, 0.0}, 1.0));
}

TEST(LookAheadStart, AStartThatIsTooFastForTheBendAheadComesDownAndIsCounted) {
  for (const Planner planner : {Planner::kPaper, Planner::kCertified}) {
    PathSettings path;
    path.planner = planner;
    double length = 0.0;
    PathMotion at{0.0, 50.0, 0.0};
    const auto sink = [&](PlannedSegment&& planned) {
      for (const Phase& phase : planned.phases) {
        EXPECT_NEAR(phase.v, at.v, 1e-6);
        EXPECT_LE(std::abs(phase.j), 50000.0 * 1.001);
        at = motion_at(phase, phase.duration);
      }
      length += planned.segment.length;
    };
    LookAhead look_ahead({}, {}, path, 1e-3, sink, {9.9, 50.0});
    for (path::Segment& segment :
         build({line_block({0, 0, 0}, {10, 0, 0}), line_block({10, 0, 0}, {10, 30, 0})})) {
      look_ahead.push(std::move(segment));
    }
    look_ahead.finish();
    EXPECT_EQ(length, 40.0);
    EXPECT_NEAR(at.v, 0.0, 1e-6);
    EXPECT_GT(look_ahead.fallbacks(), 0);
  }
}

}  // namespace look_ahead_start_test
}  // namespace twin::feedrate

#include <gtest/gtest.h>

#include "feedrate/limits/corners.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/motion_profile.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace look_ahead_corner_test {

using test::arc_block;
using test::line_block;
using test::plan;
using test::PlanSettings;

double feedrate_at_end(const PlannedSegment& planned) {
  const Phase& last = planned.phases.back();
  return motion_at(last, last.duration).v;
}

TEST(LookAheadCorner, ARightAngleIsPassedWithinTheAccelerationOfOnePeriod) {
  for (const double period : {0.25e-3, 1e-3, 4e-3}) {
    PlanSettings settings;
    settings.period = period;
    const auto planned =
        plan({line_block({0, 0, 0}, {20, 0, 0}), line_block({20, 0, 0}, {20, 20, 0})}, settings);
    test::expect_whole(planned, settings.limits);
    const double v = feedrate_at_end(planned.segments[0]);
    // sqrt(2) times the mean feedrate of the period beside the corner, v + J T^2 / 6, is A T.
    const double by_acceleration =
        2450.0 * period / std::numbers::sqrt2 - 50000.0 * period * period / 6.0;
    const double by_model = 313.95 * 0.01 * std::numbers::sqrt2;
    EXPECT_NEAR(v, std::min(by_acceleration, by_model), 1e-3);
  }
}

TEST(LookAheadCorner, TheProgrammedToleranceSetsTheCornerFeedrate) {
  std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {20, 0, 0}),
                                   line_block({20, 0, 0}, {39, 4, 0})};
  PlanSettings settings;
  settings.period = 4e-3;
  blocks[0].tolerance = blocks[1].tolerance = 0.002;
  const double turn = std::atan2(4.0, 19.0);
  EXPECT_NEAR(feedrate_at_end(plan(blocks, settings).segments[0]),
              313.95 * 0.002 / std::sin(0.5 * turn), 1e-2);
}

TEST(LookAheadCorner, ATangentArcIsNoCorner) {
  const auto line = line_block({0, 0, 0}, {20, 0, 0});
  const auto arc = arc_block({20, 0, 0}, {1, 0, 0}, 15.0, 1.0, true);
  const auto planned = plan({line, arc});
  test::expect_whole(planned, {});
  EXPECT_NEAR(feedrate_at_end(planned.segments[0]), 50.0, 1e-9);
}

TEST(LookAheadCorner, AReversalIsNearlyAStop) {
  const auto planned = plan({line_block({0, 0, 0}, {20, 0, 0}), line_block({20, 0, 0}, {0, 0, 0})});
  test::expect_whole(planned, {});
  EXPECT_LE(2.0 * feedrate_at_end(planned.segments[0]), 2450.0 * 1e-3 * (1.0 + 1e-4));
}

TEST(LookAheadCorner, CornersWithinOnePeriodActAsOne) {
  // Two right angles 1 um apart are a reversal for the set points.
  const auto planned =
      plan({line_block({0, 0, 0}, {20, 0, 0}), line_block({20, 0, 0}, {20, 0.001, 0}),
            line_block({20, 0.001, 0}, {0, 0.001, 0})});
  test::expect_whole(planned, {});
  EXPECT_EQ(planned.fallbacks, 0);
  EXPECT_LE(feedrate_at_end(planned.segments[0]), 2450.0 * 1e-3 / 2.0 + 1e-3);
}

}  // namespace look_ahead_corner_test
}  // namespace twin::feedrate

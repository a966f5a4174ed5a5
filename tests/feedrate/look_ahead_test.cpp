#include "feedrate/look_ahead.hpp"

#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace look_ahead_test {

using test::dwell_block;
using test::expect_whole;
using test::line_block;
using test::plan;
using test::PlanSettings;

std::vector<Vec3> pieces_of_line(double length, int count) {
  std::vector<Vec3> points;
  for (int i = 0; i <= count; ++i) {
    points.push_back(length * i / count * Vec3(0.6, 0.8, 0.0));
  }
  return points;
}

TEST(LookAhead, PlansALineAsItsClosedForm) {
  // 60 mm at 50 mm/s: L / V, and sqrt(V / J) lost at each end.
  const auto planned = plan({line_block({0, 0, 0}, {60, 0, 0})});
  EXPECT_NEAR(planned.time, 60.0 / 50.0 + 2.0 * std::sqrt(50.0 / 50000.0), 1e-9);
  expect_whole(planned, {});
}

TEST(LookAhead, ALineIn2000PiecesTakesAsLongAsTheUncutLine) {
  const double uncut = plan({line_block({0, 0, 0}, {60, 80, 0})}).time;
  const auto blocks = test::polyline(pieces_of_line(100.0, 2000));
  const auto curves = test::build(blocks);
  EXPECT_EQ(curves.size(), 100U);
  std::vector<path::Segment> lines;
  for (const gcode::Block& block : blocks) {
    lines.push_back(path::make_segment(block, 0, {}, {}));
  }
  for (const auto& segments : {curves, lines}) {
    const auto planned = plan(segments);
    expect_whole(planned, {});
    EXPECT_EQ(planned.fallbacks, 0);
    EXPECT_NEAR(planned.time, uncut, 1e-3);
  }
}

TEST(LookAhead, ALineIn2000PiecesTakesAsLongInEveryWindowThatHoldsItsBraking) {
  std::vector<path::Segment> lines;
  for (const auto& block : test::polyline(pieces_of_line(100.0, 2000))) {
    lines.push_back(path::make_segment(block, 0, {}, {}));
  }
  const double uncut = plan({line_block({0, 0, 0}, {60, 80, 0})}).time;
  for (const int window : {100, 200, 1000, 5000}) {
    PlanSettings settings;
    settings.look_ahead = window;
    EXPECT_NEAR(plan(lines, settings).time, uncut, 1e-3) << window;
  }
}

TEST(LookAhead, TheSameSegmentsGiveTheSamePhasesWhenever) {
  // One plan watched while it comes, another taken at the end.
  const auto segments = test::build(test::polyline(pieces_of_line(50.0, 3000)));
  std::vector<double> first;
  PathSettings path;
  path.look_ahead = 20;
  LookAhead look_ahead({}, {}, path, 1e-3, [&](PlannedSegment&& planned) {
    for (const Phase& phase : planned.phases) {
      first.insert(first.end(), {phase.duration, phase.s, phase.v, phase.a, phase.j});
    }
  });
  std::size_t pushed = 0;
  bool is_streamed = false;
  for (path::Segment segment : segments) {
    look_ahead.push(std::move(segment));
    is_streamed = is_streamed || (++pushed < segments.size() && !first.empty());
  }
  look_ahead.finish();
  EXPECT_TRUE(is_streamed);
  std::vector<double> second;
  PlanSettings settings;
  settings.look_ahead = 20;
  for (const PlannedSegment& planned : plan(segments, settings).segments) {
    for (const Phase& phase : planned.phases) {
      second.insert(second.end(), {phase.duration, phase.s, phase.v, phase.a, phase.j});
    }
  }
  EXPECT_EQ(first, second);
}

TEST(LookAhead, ADwellTakesItsTimeAtRest) {
  const std::vector<gcode::Block> move{line_block({0, 0, 0}, {20, 0, 0}),
                                       line_block({20, 0, 0}, {40, 0, 0})};
  const std::vector<gcode::Block> rest{move[0], dwell_block({20, 0, 0}, 0.7), move[1]};
  const auto planned = plan(rest);
  expect_whole(planned, {});
  const double alone = plan(std::vector<gcode::Block>{move[0]}).time;
  EXPECT_NEAR(planned.time, 2.0 * alone + 0.7, 1e-9);
}

TEST(LookAhead, DwellsAloneAreAProgram) {
  const auto planned = plan({dwell_block({1, 2, 3}, 0.25), dwell_block({1, 2, 3}, 0.0)});
  ASSERT_EQ(planned.segments.size(), 2U);
  EXPECT_EQ(planned.time, 0.25);
}

TEST(LookAhead, NothingGivesNothing) {
  EXPECT_TRUE(plan(std::vector<gcode::Block>{}).segments.empty());
}

TEST(LookAhead, AnExactStopComesToRestAtTheEndOfTheBlock) {
  std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {20, 0, 0}),
                                   line_block({20, 0, 0}, {40, 0, 0})};
  const double through = plan(blocks).time;
  blocks[0].path_mode = gcode::PathMode::kExactStop;
  const auto planned = plan(blocks);
  expect_whole(planned, {});
  const Phase& last = planned.segments[0].phases.back();
  EXPECT_NEAR(motion_at(last, last.duration).v, 0.0, 1e-6);
  EXPECT_NEAR(planned.time - through, 2.0 * std::sqrt(50.0 / 50000.0), 1e-9);
}

TEST(LookAhead, ARepeatedFeedrateChangesNothingAndAChangedOneIsKeptFromTheBorderOn) {
  std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {20, 0, 0}, 50.0),
                                   line_block({20, 0, 0}, {40, 0, 0}, 20.0),
                                   line_block({40, 0, 0}, {60, 0, 0}, 80.0)};
  const auto planned = plan(blocks);
  expect_whole(planned, {});
  EXPECT_NEAR(planned.segments[1].phases.front().v, 20.0, 1e-4);
  EXPECT_NEAR(planned.segments[2].phases.front().v, 20.0, 1e-4);
}

TEST(LookAhead, RampToACornerMayBeLongerThanTheRampToRest) {
  // From 90 mm/s to 30 mm/s with no acceleration takes 4.16 mm, to rest only 3.82 mm: a anchor that
  // can just stop before the window's end is too late for a corner there.
  for (const double piece : {0.1, 0.2, 0.4, 0.6}) {
    std::vector<path::Segment> segments{
        path::make_segment(line_block({0, 0, 0}, {12, 0, 0}, 90.0), 0, {}, {})};
    for (int i = 0; i < 40; ++i) {
      const double heading = i % 2 == 0 ? 0.07 : 0.0;
      const Vec3 start = segments.back().end.position;
      const Vec3 end = start + piece * Vec3(std::cos(heading), std::sin(heading), 0.0);
      segments.push_back(path::make_segment(line_block(start, end, 90.0), 0, {}, {}));
    }
    for (const int window : {2, 3, 5}) {
      PlanSettings settings;
      settings.look_ahead = window;
      const auto planned = plan(segments, settings);
      EXPECT_EQ(planned.fallbacks, 0);
      expect_whole(planned, settings.limits);
    }
  }
}

TEST(LookAhead, HoldsTheRapidFeedrateOnRapids) {
  std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {50, 0, 0}, 0.0)};
  blocks[0].motion = gcode::Motion::kRapid;
  PlanSettings settings;
  settings.limits.rapid_feedrate = 80.0;
  const auto planned = plan(blocks, settings);
  double fastest = 0.0;
  for (const Phase& phase : planned.segments[0].phases) {
    fastest = std::max(fastest, phase.v);
  }
  EXPECT_NEAR(fastest, 80.0, 1e-9);
}

}  // namespace look_ahead_test
}  // namespace twin::feedrate

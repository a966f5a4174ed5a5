#include "path/smooth_builder.hpp"

#include <gtest/gtest.h>

#include "tests/path/smooth_path.hpp"

namespace twin::path {
namespace smooth_builder_test {

using test::arc_block;
using test::circle_points;
using test::dwell_block;
using test::expect_marks;
using test::expect_smooth_joints;
using test::expect_within_bounds;
using test::is_curve;
using test::is_line;
using test::line_block;
using test::polyline;
using test::smooth;

double length_of(const std::vector<Segment>& segments) {
  double length = 0.0;
  for (const Segment& segment : segments) {
    length += segment.length;
  }
  return length;
}

TEST(SmoothBuilder, RoundsACornerOfLongLinesAndLeavesTheRestExact) {
  const auto blocks = polyline({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}});
  const auto segments = smooth(blocks);
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_TRUE(is_line(segments[0]) && is_curve(segments[1]) && is_line(segments[2]));
  EXPECT_EQ(segments[0].deviation, 0.0);
  EXPECT_GT(segments[1].deviation, 0.0096);
  EXPECT_FALSE(segments[1].stops_at_end);
  expect_smooth_joints(segments);
  expect_marks(segments, 2);
  expect_within_bounds(segments, blocks, 0.01);
  // The corner is cut by no more than the tolerance, of which at least 95 % are used.
  const Segment& corner = segments[1];
  const PathPoint middle = test::place(corner, 0.5 * corner.length);
  const double cut = (middle.position - blocks[0].end).norm();
  EXPECT_LE(cut, 0.01);
  EXPECT_GE(cut, 0.95 * 0.01);
  // The bump: |C''| = |D| / h, |C'|^2 = 1/2 in the middle, D = sqrt 2, h = 6 e / D, e the cut.
  const double h = 6.0 * cut / std::sqrt(2.0);
  EXPECT_NEAR(middle.curvature.norm(), std::sqrt(2.0) / h * 2.0, 1e-3 / h);
}

TEST(SmoothBuilder, TakesTheToleranceOfG64P) {
  for (const double tolerance : {0.002, 0.05}) {
    auto blocks = polyline({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}});
    for (gcode::Block& block : blocks) {
      block.tolerance = tolerance;
    }
    const auto segments = smooth(blocks);
    ASSERT_EQ(segments.size(), 3U);
    EXPECT_LE(segments[1].deviation, tolerance);
    EXPECT_GT(segments[1].deviation, 0.96 * tolerance);
  }
}

TEST(SmoothBuilder, ComesToRestWhereThePathTurnsBack) {
  const auto segments = smooth(polyline({{0, 0, 0}, {20, 0, 0}, {5, 0, 0}}));
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_TRUE(segments[0].stops_at_end);
  EXPECT_TRUE(is_line(segments[0]) && is_line(segments[1]));
}

TEST(SmoothBuilder, KeepsExactStopsSharp) {
  auto blocks = polyline({{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}});
  blocks[1].path_mode = gcode::PathMode::kExactStop;
  const auto segments = smooth(blocks);
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_TRUE(std::all_of(segments.begin(), segments.end(), is_line));
  EXPECT_TRUE(segments[0].stops_at_end && segments[1].stops_at_end);
  EXPECT_EQ(segments[1].length, 20.0);
}

TEST(SmoothBuilder, BlendsTheCurvatureJumpOfATangentArc) {
  std::vector<gcode::Block> blocks = polyline({{0, 0, 0}, {20, 0, 0}});
  blocks.push_back(arc_block({20, 0, 0}, {1, 0, 0}, 8.0, 2.0, true));
  const auto segments = smooth(blocks);
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_TRUE(std::holds_alternative<Arc>(segments[2].geometry));
  expect_smooth_joints(segments);
  expect_within_bounds(segments, blocks, 0.01);
  expect_marks(segments, 2);
}

TEST(SmoothBuilder, ChangesTheFeedrateWithoutMovingThePath) {
  auto points = circle_points(30.0, 0.3, 200);
  const auto blocks = polyline(points);
  auto slower = blocks;
  for (std::size_t i = 80; i < slower.size(); ++i) {
    slower[i].feedrate = 20.0;
  }
  const auto a = smooth(blocks);
  const auto b = smooth(slower);
  EXPECT_NEAR(length_of(a), length_of(b), 1e-9);
  expect_smooth_joints(b);
  expect_marks(b, 200);
  for (const Segment& segment : b) {
    for (const BlockMark& mark : segment.marks) {
      EXPECT_EQ(segment.feedrate, mark.block < 80 ? 50.0 : 20.0);
    }
  }
}

TEST(SmoothBuilder, MakesTheSameLineOfAnyNumberOfPieces) {
  for (const int count : {1, 10, 2000, 20000}) {
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) {
      points.push_back(400.0 * i / count * Vec3(0.6, 0.8, 0.0));
    }
    const auto segments = smooth(polyline(points));
    EXPECT_NEAR(length_of(segments), 400.0, 1e-9);
    for (const Segment& segment : segments) {
      EXPECT_LT(test::place(segment, 0.5 * segment.length).curvature.norm(), 1e-9);
      EXPECT_LT(segment.deviation, 1e-9);
    }
  }
}

TEST(SmoothBuilder, NeedsFarFewerSpansThanBlocks) {
  const auto segments = smooth(polyline(circle_points(30.0, 0.26, 2000)));
  std::size_t spans = 0;
  for (const Segment& segment : segments) {
    spans += std::get<FittedCurve>(segment.geometry).curve.control_points().size() - 3;
  }
  EXPECT_LT(spans, 200U);
  EXPECT_LT(segments.size(), 10U);
}

TEST(SmoothBuilder, LeavesOutSpecks) {
  auto points =
      std::vector<Vec3>{{0, 0, 0}, {10, 0, 0}, {10, 1e-5, 0}, {20, 0, 0}, {20 + 1e-6, 0, 0}};
  const auto segments = smooth(polyline(points));
  expect_marks(segments, 4);
  EXPECT_EQ(segments.back().end.position, points.back());
  for (const Segment& segment : segments) {
    EXPECT_LT(test::place(segment, 0.5 * segment.length).curvature.norm(), 1e-3);
  }
  EXPECT_TRUE(std::any_of(segments.begin(), segments.end(),
                          [](const Segment& segment) { return segment.deviation >= 1e-5; }));
}

// The speck was the line from then on: 10 mm behind a block of 10 nm had that block's F, whether
// lower or higher than their own.
TEST(SmoothBuilder, ALineBehindASpeckHasItsOwnFeedrate) {
  for (const double feedrate : {1.0, 100.0}) {
    const auto segments = smooth({line_block({0, 0, 0}, {10, 0, 0}, 20.0),
                                  line_block({10, 0, 0}, {10, 1e-5, 0}, feedrate),
                                  line_block({10, 1e-5, 0}, {10, 10, 0}, 50.0)});
    double length = 0.0;
    for (const Segment& segment : segments) {
      EXPECT_NE(segment.feedrate, feedrate);
      length += segment.feedrate == 50.0 ? segment.length : 0.0;
    }
    EXPECT_NEAR(length, 10.0, 0.05) << feedrate;
  }
}

// What begins with a speck was a short block, whatever its length.
TEST(SmoothBuilder, ALineBehindASpeckIsAsShortAsItIs) {
  std::vector<Vec3> points{{0, 0, 0}, {1e-5, 0, 0}, {30, 0, 0}, {30.1, 0.001, 0}};
  const auto segments = smooth(polyline(points));
  ASSERT_FALSE(segments.empty());
  EXPECT_TRUE(std::holds_alternative<Line>(segments.front().geometry));
}

TEST(SmoothBuilder, RestsAtDwells) {
  std::vector<gcode::Block> blocks = polyline(circle_points(10.0, 0.3, 20));
  blocks.push_back(dwell_block(blocks.back().end, 0.5));
  blocks.push_back(line_block(blocks.back().end, {0, 0, 0}));
  const auto segments = smooth(blocks);
  ASSERT_GE(segments.size(), 3U);
  EXPECT_EQ(segments[segments.size() - 2].dwell, 0.5);
  expect_marks(segments, 22);
}

/// A cubic with one span through four control points.
gcode::Block cubic_block(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  gcode::Block block;
  block.motion = gcode::Motion::kNurbs;
  block.start = a;
  block.end = d;
  block.feedrate = 50.0;
  block.nurbs = *gcode::make_programmed_curve(
      *geometry::Curve::create(3, {0, 0, 0, 0, 1, 1, 1, 1}, {a, b, c, d}));
  return block;
}

std::vector<Vec3> points_of_curves(const std::vector<gcode::Block>& blocks) {
  std::vector<Vec3> points;
  for (const gcode::Block& block : blocks) {
    for (int i = 0; i <= 4000; ++i) {
      points.push_back(block.nurbs ? block.nurbs->curve.position(i / 4000.0)
                                   : Vec3(block.start + i / 4000.0 * (block.end - block.start)));
    }
  }
  return points;
}

// Kinks of a thousandth of a degree, corners, and a line between two of them.
TEST(SmoothBuilder, JointsOfNurbsAreRoundedWithinTheToleranceLikeAnyCorner) {
  const std::vector<gcode::Block> blocks{
      cubic_block({0, 0, 0}, {2, 0, 0}, {4, 1, 0}, {6, 1, 0}),
      cubic_block({6, 1, 0}, {8, 1.0001, 0}, {9, 3, 0}, {9, 5, 0}),
      cubic_block({9, 5, 0}, {11, 5, 0}, {12, 6, 1}, {14, 6, 1}),
      test::line_block({14, 6, 1}, {14, 12, 1}),
      cubic_block({14, 12, 1}, {12, 14, 1}, {10, 14, 0}, {8, 13, 0})};
  const auto segments = test::smooth(blocks);
  const auto program = points_of_curves(blocks);
  test::expect_smooth_joints(segments);
  test::expect_marks(segments, 5);
  std::vector<Vec3> path;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_TRUE(!segments[i].stops_at_end) << "segment " << i;
    EXPECT_LE(segments[i].deviation, 0.01);
    for (const Vec3& p : test::path_points(segments[i])) {
      EXPECT_LE(test::distance_to_polyline(p, program), segments[i].deviation + 1e-6);
      path.push_back(p);
    }
  }
  for (std::size_t i = 0; i < program.size(); i += 25) {
    EXPECT_LE(test::distance_to_polyline(program[i], path), 0.01);
  }
}

// A curve that ended in the middle of a corner left half a bend to each of two curves, and half a bend counts as one
// that lasts: every tenth corner of a zigzag was slow.
TEST(SmoothBuilder, NoCurveEndsInTheMiddleOfACorner) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) {
    points.emplace_back(0.1 * ((i + 1) / 2), 0.1 * (i / 2), 0.0);
  }
  const auto segments = test::smooth(test::polyline(points, 50.0));
  ASSERT_GT(segments.size(), 10U);
  for (const Segment& segment : segments) {
    EXPECT_LT(segment.begin.curvature.norm(), 1e-6);
    EXPECT_LT(segment.end.curvature.norm(), 1e-6);
  }
}

TEST(SmoothBuilder, ANurbsThatIsNotJoinedStaysAsItIs) {
  const auto block = cubic_block({0, 0, 0}, {2, 0, 0}, {4, 1, 0}, {6, 1, 0});
  const auto segments = test::smooth({block});
  ASSERT_EQ(segments.size(), 1U);
  const auto& curve = std::get<FittedCurve>(segments[0].geometry);
  EXPECT_TRUE(curve.is_programmed);
  EXPECT_EQ(curve.curve.control_points(), block.nurbs->curve.control_points());
}

}  // namespace smooth_builder_test
}  // namespace twin::path

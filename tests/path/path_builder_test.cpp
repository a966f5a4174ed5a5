#include "path/path_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/blocks.hpp"

namespace twin::path {
namespace path_builder_test {

using test::arc_block;
using test::build;
using test::circle_points;
using test::dwell_block;
using test::is_curve;
using test::is_line;
using test::line_block;
using test::polyline;

/// Every block once and in order, and the marks of each segment ascending to its end.
void expect_all_blocks(const std::vector<Segment>& segments, std::size_t count) {
  std::int64_t next = 0;
  for (const Segment& segment : segments) {
    double before = 0.0;
    ASSERT_FALSE(segment.marks.empty());
    for (const BlockMark& mark : segment.marks) {
      EXPECT_EQ(mark.block, next++);
      EXPECT_GE(mark.end, before);
      before = mark.end;
    }
    EXPECT_EQ(before, segment.length);
  }
  EXPECT_EQ(next, static_cast<std::int64_t>(count));
}

TEST(PathBuilder, LeavesLongLinesRapidsArcsAndDwellsAsTheyAre) {
  std::vector<gcode::Block> blocks = polyline({{0, 0, 0}, {20, 0, 0}, {40, 0.1, 0}, {60, 0, 0}});
  blocks.push_back(arc_block({60, 0, 0}, {1, 0, 0}, 5.0, 1.0, true));
  blocks.push_back(dwell_block(blocks.back().end, 0.5));
  blocks.push_back(line_block(blocks.back().end, {0, 0, 0}));
  blocks.back().motion = gcode::Motion::kRapid;
  const auto segments = build(blocks);
  ASSERT_EQ(segments.size(), blocks.size());
  EXPECT_TRUE(std::all_of(segments.begin(), segments.begin() + 3, is_line));
  EXPECT_TRUE(std::holds_alternative<Arc>(segments[3].geometry));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(segments[4].geometry));
  EXPECT_TRUE(is_line(segments[5]));
  EXPECT_TRUE(segments[5].is_rapid);
  expect_all_blocks(segments, blocks.size());
}

TEST(PathBuilder, LeavesCornersBelowTheCriticalAngleAsLines) {
  // Chords of 0.3 mm that turn by 8 deg: more than the 7.2 deg that 50 mm/s allows.
  const double turn = 8.0 * std::numbers::pi / 180.0;
  const double radius = 0.15 / std::sin(0.5 * turn);
  const auto points = circle_points(radius, radius * turn, 40);
  const auto segments = build(polyline(points, 50.0));
  EXPECT_EQ(segments.size(), 40U);
  EXPECT_TRUE(std::all_of(segments.begin(), segments.end(), is_line));
  const auto slower = build(polyline(points, 40.0));
  EXPECT_EQ(slower.size(), 2U);
  EXPECT_TRUE(std::all_of(slower.begin(), slower.end(), is_curve));
}

TEST(PathBuilder, LeavesChordsWithTooMuchSagittaAsLines) {
  // Turn 4 deg, within the angle; sagitta L^2 / (8 R) = L turn / 8.
  const double turn = 4.0 * std::numbers::pi / 180.0;
  for (const double length : {1.0, 1.3, 1.6, 2.0}) {
    const double radius = 0.5 * length / std::sin(0.5 * turn);
    const auto segments = build(polyline(circle_points(radius, radius * turn, 9)));
    EXPECT_EQ(is_curve(segments[0]), length * turn / 8.0 < 0.01) << length;
  }
}

TEST(PathBuilder, FitsRunsOfAtLeastThreeBlocks) {
  for (const int count : {1, 2}) {
    const auto segments = build(polyline(circle_points(10.0, 0.3, count)));
    EXPECT_EQ(segments.size(), static_cast<std::size_t>(count));
    EXPECT_TRUE(std::all_of(segments.begin(), segments.end(), is_line));
  }
  const auto segments = build(polyline(circle_points(10.0, 0.3, 3)));
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_TRUE(is_curve(segments[0]));
  EXPECT_EQ(segments[0].marks.size(), 3U);
}

TEST(PathBuilder, MakesCurvesOfAtMostMaxSegmentsOfRunsOfAnyLength) {
  for (const int most : {3, 5, 20, 50}) {
    PathSettings settings;
    settings.max_segments = most;
    for (int count = 3; count < 130; ++count) {
      const auto segments = build(polyline(circle_points(20.0, 0.2, count)), settings);
      expect_all_blocks(segments, static_cast<std::size_t>(count));
      EXPECT_TRUE(std::all_of(segments.begin(), segments.end(), is_curve)) << count;
      const auto fewest = static_cast<std::size_t>((count + most - 1) / most);
      EXPECT_GE(segments.size(), fewest);
      EXPECT_LE(segments.size(), fewest + 1);
      for (const Segment& segment : segments) {
        EXPECT_LE(segment.marks.size(), static_cast<std::size_t>(most));
      }
    }
  }
}

TEST(PathBuilder, TakesEachBlockOnceAndInOrderWhateverTheInput) {
  std::mt19937 random(7);
  for (int i = 0; i < 60; ++i) {
    auto blocks = polyline(test::random_walk(random, 200, 0.003, 2.0, 0.1 * (i % 12)),
                           i % 2 == 0 ? 2.0 : 40.0);
    for (gcode::Block& block : blocks) {
      block.path_mode =
          random() % 40 == 0 ? gcode::PathMode::kExactStop : gcode::PathMode::kContinuous;
      block.feedrate *= random() % 10 == 0 ? 0.5 : 1.0;
      block.tolerance = random() % 30 == 0 ? 0.02 : 0.0;
    }
    const auto segments = build(blocks);
    expect_all_blocks(segments, blocks.size());
    for (std::size_t k = 1; k < segments.size(); ++k) {
      EXPECT_LT((segments[k].begin.position - segments[k - 1].end.position).norm(), 1e-12);
    }
  }
}

TEST(PathBuilder, MarksEndWhereTheBlocksEnd) {
  const auto points = circle_points(3.0, 0.2, 90);
  std::size_t next = 1;
  for (const Segment& segment : build(polyline(points))) {
    const auto& fitted = std::get<FittedCurve>(segment.geometry);
    for (const BlockMark& mark : segment.marks) {
      const double u = fitted.arc_length.u_at(fitted.curve, mark.end, 0.0);
      EXPECT_LT((fitted.curve.position(u) - points[next]).norm(), 1e-9);
      EXPECT_NEAR(mark.length, (points[next] - points[next - 1]).norm(), 1e-15);
      EXPECT_EQ(mark.line, static_cast<std::int64_t>(next));
      ++next;
    }
  }
}

TEST(PathBuilder, FollowsExactStopBlocksExactly) {
  auto blocks = polyline(circle_points(20.0, 0.2, 30));
  for (std::size_t i = 10; i < 20; ++i) {
    blocks[i].path_mode = gcode::PathMode::kExactStop;
  }
  const auto segments = build(blocks);
  ASSERT_EQ(segments.size(), 12U);
  EXPECT_TRUE(is_curve(segments.front()));
  EXPECT_TRUE(is_curve(segments.back()));
  for (std::size_t i = 1; i <= 10; ++i) {
    EXPECT_TRUE(is_line(segments[i]));
    EXPECT_TRUE(segments[i].stops_at_end);
  }
}

TEST(PathBuilder, CutsARunWhereTheToleranceChanges) {
  auto blocks = polyline(circle_points(20.0, 0.2, 16));
  for (std::size_t i = 8; i < 16; ++i) {
    blocks[i].tolerance = 0.05;
  }
  const auto segments = build(blocks);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].marks.size(), 8U);
  EXPECT_EQ(segments[0].corner_error, PlanningModel{}.corner_error);
  EXPECT_EQ(segments[1].corner_error, 0.05);
}

TEST(PathBuilder, FitsShortBlocksInSpaceToo) {
  auto points = circle_points(20.0, 0.2, 20);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].z() = 0.05 * static_cast<double>(i);
  }
  const auto segments = build(polyline(points));
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_TRUE(is_curve(segments[0]));
  EXPECT_LT((segments[0].end.position - points.back()).norm(), 1e-13);
}

TEST(PathBuilder, MakesCurvesWithoutCurvatureOfAStraightLineInPieces) {
  for (const double piece : {0.05, 0.37, 3.0}) {
    std::vector<Vec3> points;
    for (int i = 0; i <= 200; ++i) {
      points.emplace_back(0.8 * piece * i, 0.6 * piece * i, 0.0);
    }
    double length = 0.0;
    for (const Segment& segment : build(polyline(points))) {
      ASSERT_TRUE(is_curve(segment));
      length += segment.length;
      for (const auto& sample : std::get<FittedCurve>(segment.geometry).curvature) {
        EXPECT_LT(sample.curvature, 1e-9);
      }
    }
    EXPECT_NEAR(length, 200.0 * piece, 1e-9);
  }
}

}  // namespace path_builder_test
}  // namespace twin::path

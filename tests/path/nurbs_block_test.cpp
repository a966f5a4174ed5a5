#include <gtest/gtest.h>

#include "gcode/block.hpp"
#include "tests/support/blocks.hpp"

namespace twin::path {
namespace nurbs_block_test {

using test::build;
using test::circle_points;
using test::is_curve;
using test::polyline;

gcode::Block nurbs_block(int degree, std::vector<double> knots, std::vector<Vec3> points) {
  gcode::Block block;
  block.motion = gcode::Motion::kNurbs;
  block.start = points.front();
  block.end = points.back();
  block.feedrate = 30.0;
  block.tolerance = 0.02;
  block.line = 7;
  block.nurbs = *gcode::make_programmed_curve(
      *geometry::Curve::create(degree, std::move(knots), std::move(points)));
  return block;
}

/// Cubic with so many spans of length 1.
gcode::Block wave(int spans) {
  std::vector<double> knots(4, 0.0);
  std::vector<Vec3> points;
  for (int i = 0; i < spans + 3; ++i) {
    points.emplace_back(i, i % 2, 0.0);
  }
  for (int i = 1; i < spans; ++i) {
    knots.push_back(i);
  }
  knots.insert(knots.end(), 4, spans);
  return nurbs_block(3, knots, points);
}

TEST(NurbsBlock, OfFewSpansIsOneSegment) {
  const auto segments = build({wave(20)});
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_TRUE(is_curve(segments[0]));
  EXPECT_EQ(segments[0].feedrate, 30.0);
  EXPECT_EQ(segments[0].corner_error, 0.02);
  ASSERT_EQ(segments[0].marks.size(), 1U);
  EXPECT_EQ(segments[0].marks[0].line, 7);
  EXPECT_TRUE(std::get<FittedCurve>(segments[0].geometry).is_programmed);
}

TEST(NurbsBlock, OfManySpansIsCutAndJoinsWithTangentAndCurvature) {
  const gcode::Block block = wave(90);
  const auto segments = build({block});
  ASSERT_EQ(segments.size(), 5U);
  double length = 0.0;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    length += segments[i].length;
    EXPECT_EQ(segments[i].marks.at(0).block, 0);
    if (i > 0) {
      EXPECT_LT((segments[i].begin.position - segments[i - 1].end.position).norm(), 1e-12);
      EXPECT_LT((segments[i].begin.tangent - segments[i - 1].end.tangent).norm(), 1e-12);
      EXPECT_LT((segments[i].begin.curvature - segments[i - 1].end.curvature).norm(), 1e-10);
    }
  }
  EXPECT_NEAR(length, block.nurbs->arc_length.length(), 1e-8);
}

TEST(NurbsBlock, IsCutWhereItsTangentTurns) {
  const auto segments = build(
      {nurbs_block(3, {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2},
                   {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 2, 0}, {3, 3, 0}})});
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_LT((segments[0].end.tangent - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((segments[1].begin.tangent - Vec3::UnitY()).norm(), 1e-12);
}

TEST(NurbsBlock, EndsTheRunBeforeIt) {
  auto blocks = polyline(circle_points(30.0, 0.3, 12));
  gcode::Block block = wave(3);
  blocks.push_back(block);
  const auto segments = build(blocks);
  EXPECT_TRUE(std::get<FittedCurve>(segments.back().geometry).is_programmed);
  EXPECT_EQ(segments.back().marks[0].block, 12);
  EXPECT_FALSE(std::get<FittedCurve>(segments.front().geometry).is_programmed);
}

}  // namespace nurbs_block_test
}  // namespace twin::path

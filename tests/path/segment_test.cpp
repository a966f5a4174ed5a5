#include "path/segment.hpp"

#include <gtest/gtest.h>

#include "geometry/nurbs/fit.hpp"
#include "tests/support/blocks.hpp"

namespace twin::path {
namespace segment_test {

using test::dwell_block;
using test::line_block;

TEST(Line, RunsStraightAtUnitPace) {
  const Line line{{1, 2, 3}, Vec3(2, -1, 2) / 3.0};
  const PathPoint at = point_at(line, 6.0);
  EXPECT_LT((at.position - Vec3(5, 0, 7)).norm(), 1e-15);
  EXPECT_EQ(at.tangent, line.direction);
  EXPECT_EQ(at.curvature, Vec3::Zero());
}

TEST(PointFrom, TakesTheParametersPaceOutOfTangentAndCurvature) {
  // C(u) = (3 u, u^2, 0) at u = 2: C' = (3, 4, 0), C'' = (0, 2, 0), kappa = |C' x C''| / |C'|^3.
  const PathPoint at = point_from({{6, 4, 0}, {3, 4, 0}, {0, 2, 0}});
  EXPECT_LT((at.tangent - Vec3(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_NEAR(at.curvature.norm(), 6.0 / 125.0, 1e-15);
  EXPECT_NEAR(at.curvature.dot(at.tangent), 0.0, 1e-15);
  EXPECT_GT(at.curvature.y(), 0.0);
}

TEST(PointFrom, OfACuspIsFinite) {
  const PathPoint at = point_from({{1, 2, 3}, Vec3::Zero(), {1, 0, 0}});
  EXPECT_EQ(at.position, Vec3(1, 2, 3));
  EXPECT_EQ(at.tangent.norm(), 1.0);
  EXPECT_EQ(at.curvature, Vec3::Zero());
}

TEST(MakeSegment, OfALineHasItsLengthEndsAndMark) {
  gcode::Block block = line_block({1, 1, 0}, {4, 5, 0}, 30.0);
  block.line = 17;
  const Segment segment = make_segment(block, 5, {}, {});
  EXPECT_DOUBLE_EQ(segment.length, 5.0);
  EXPECT_EQ(segment.begin.position, block.start);
  EXPECT_LT((segment.end.position - block.end).norm(), 1e-14);
  EXPECT_EQ(segment.feedrate, 30.0);
  ASSERT_EQ(segment.marks.size(), 1U);
  EXPECT_EQ(segment.marks[0].block, 5);
  EXPECT_EQ(segment.marks[0].line, 17);
  EXPECT_EQ(segment.marks[0].end, segment.length);
  EXPECT_FALSE(segment.stops_at_end);
}

TEST(MakeSegment, NeverAsksForMoreFeedrateThanTheMachineHas) {
  Limits limits;
  limits.feedrate = 20.0;
  limits.rapid_feedrate = 70.0;
  gcode::Block block = line_block({0, 0, 0}, {1, 0, 0}, 30.0);
  EXPECT_EQ(make_segment(block, 0, limits, {}).feedrate, 20.0);
  block.motion = gcode::Motion::kRapid;
  block.feedrate = 0.0;
  const Segment rapid = make_segment(block, 0, limits, {});
  EXPECT_EQ(rapid.feedrate, 70.0);
  EXPECT_TRUE(rapid.is_rapid);
}

TEST(MakeSegment, TakesTheProgrammedToleranceAsCornerError) {
  PlanningModel model;
  model.corner_error = 0.01;
  gcode::Block block = line_block({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(make_segment(block, 0, {}, model).corner_error, 0.01);
  block.tolerance = 0.3;
  EXPECT_EQ(make_segment(block, 0, {}, model).corner_error, 0.3);
}

TEST(MakeSegment, OfADwellRestsWhereItIs) {
  const Segment segment = make_segment(dwell_block({1, 2, 3}, 0.25), 0, {}, {});
  EXPECT_EQ(segment.length, 0.0);
  EXPECT_EQ(segment.dwell, 0.25);
  EXPECT_TRUE(segment.stops_at_end);
  EXPECT_EQ(segment.begin.position, Vec3(1, 2, 3));
  EXPECT_EQ(segment.end.position, Vec3(1, 2, 3));
}

TEST(MakeSegment, OfAnExactStopBlockStopsAtItsEnd) {
  gcode::Block block = line_block({0, 0, 0}, {1, 0, 0});
  block.path_mode = gcode::PathMode::kExactStop;
  EXPECT_TRUE(make_segment(block, 0, {}, {}).stops_at_end);
}

FittedCurve circle_curve(double radius, double chord, int count) {
  geometry::Fitter fitter;
  FittedCurve fitted;
  EXPECT_EQ(fitter.fit(testing::circle_points(radius, chord, count), {}, {}, fitted.curve),
            geometry::FitResult::kFitted);
  measure(fitted);
  return fitted;
}

TEST(CurveSegment, ThroughPointsOfACircleIsAsLongAsTheArc) {
  const Segment segment = make_curve_segment(circle_curve(5.0, 0.2, 20));
  EXPECT_NEAR(segment.length, 4.0, 1e-6);
}

TEST(CurveSegment, BeginsAndEndsOnTheCircleAlongItsTangents) {
  const Segment segment = make_curve_segment(circle_curve(5.0, 0.2, 20));
  EXPECT_LT((segment.begin.position - Vec3(5, 0, 0)).norm(), 1e-14);
  EXPECT_LT((segment.begin.tangent - Vec3(0, 1, 0)).norm(), 1e-4);
  EXPECT_LT((segment.end.position - 5.0 * Vec3(std::cos(0.8), std::sin(0.8), 0)).norm(), 1e-13);
  EXPECT_LT((segment.end.tangent - Vec3(-std::sin(0.8), std::cos(0.8), 0)).norm(), 1e-4);
  EXPECT_NEAR(segment.end.curvature.norm(), 0.2, 0.01);
}

TEST(CurveSegment, HasCurvatureSamplesFromEndToEnd) {
  const Segment segment = make_curve_segment(circle_curve(2.0, 0.1, 15));
  const auto& samples = std::get<FittedCurve>(segment.geometry).curvature;
  EXPECT_EQ(samples.front().s, 0.0);
  EXPECT_NEAR(samples.back().s, segment.length, 1e-9);
  for (std::size_t i = 1; i < samples.size(); ++i) {
    EXPECT_GT(samples[i].s, samples[i - 1].s);
    EXPECT_NEAR(samples[i].curvature, 0.5, 0.02);
  }
}

}  // namespace segment_test
}  // namespace twin::path

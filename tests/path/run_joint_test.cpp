#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"

namespace twin::path {
namespace run_joint_test {

using test::build;
using test::is_curve;
using test::polyline;

/// Joints of successive curves: position, tangent and curvature (with its direction) the same on
/// both sides.
std::size_t expect_smooth_joints(const std::vector<Segment>& segments) {
  std::size_t joints = 0;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const Segment& a = segments[i - 1];
    const Segment& b = segments[i];
    EXPECT_TRUE(is_curve(a) && is_curve(b));
    EXPECT_LT((a.end.position - b.begin.position).norm(), 1e-12);
    EXPECT_LT((a.end.tangent - b.begin.tangent).norm(), 1e-8);
    EXPECT_LT((a.end.curvature - b.begin.curvature).norm(), 1e-8);
    ++joints;
  }
  return joints;
}

double four_decimals(double x) { return std::round(x * 1e4) * 1e-4; }

/// A closed wavy outline, r = 10 + sin(5 a), in chords of 0.15 to 0.25 mm, rounded as CAM does.
std::vector<Vec3> wavy_points() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 400.0;
    const double r = 10.0 + std::sin(5.0 * a);
    points.emplace_back(four_decimals(r * std::cos(a)), four_decimals(r * std::sin(a)), 0.0);
  }
  return points;
}

TEST(RunJoint, OfALongRunHasContinuousPositionTangentAndCurvature) {
  EXPECT_GE(expect_smooth_joints(build(polyline(wavy_points()))), 19U);
}

TEST(RunJoint, AtAChangeOfFeedrateIsSmoothToo) {
  auto blocks = polyline(wavy_points(), 40.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].feedrate = i / 7 % 2 == 0 ? 40.0 : 35.0;
  }
  const auto segments = build(blocks);
  EXPECT_GE(expect_smooth_joints(segments), blocks.size() / 7);
  for (const Segment& segment : segments) {
    for (const BlockMark& mark : segment.marks) {
      EXPECT_EQ(segment.feedrate, blocks[static_cast<std::size_t>(mark.block)].feedrate);
    }
  }
}

TEST(RunJoint, OfCurvesOfASingleBlockIsSmoothToo) {
  auto blocks = polyline(wavy_points(), 40.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].feedrate = 30.0 + static_cast<double>(i % 5);
  }
  const auto segments = build(blocks);
  EXPECT_EQ(segments.size(), blocks.size());
  expect_smooth_joints(segments);
}

TEST(RunJoint, OfBezierPiecesHasContinuousTangentButNotCurvature) {
  PathSettings settings;
  settings.curves = CurveKind::kBezier;
  const auto segments = build(polyline(wavy_points()), settings);
  ASSERT_GE(segments.size(), 20U);
  double largest = 0.0;
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const Segment& a = segments[i - 1];
    const Segment& b = segments[i];
    EXPECT_TRUE(is_curve(a) && is_curve(b));
    EXPECT_LT((a.end.position - b.begin.position).norm(), 1e-12);
    EXPECT_LT((a.end.tangent - b.begin.tangent).norm(), 1e-12);
    largest = std::max(largest, (a.end.curvature - b.begin.curvature).norm());
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(RunJoint, LinearInterpolatorFitsNothing) {
  PathSettings settings;
  settings.curves = CurveKind::kNone;
  for (const Segment& segment : build(polyline(wavy_points()), settings)) {
    EXPECT_TRUE(test::is_line(segment));
  }
}

TEST(RunJoint, DoesNotDependOnHowManyBlocksFollow) {
  const auto points = wavy_points();
  const auto whole = build(polyline(points));
  const auto part = build(polyline({points.begin(), points.begin() + 101}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(whole[i].length, part[i].length);
    EXPECT_EQ(whole[i].end.tangent, part[i].end.tangent);
  }
}

}  // namespace run_joint_test
}  // namespace twin::path

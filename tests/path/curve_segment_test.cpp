#include "path/curve_segment.hpp"

#include <gtest/gtest.h>

#include "geometry/nurbs/fit.hpp"
#include "tests/support/blocks.hpp"

namespace twin::path {
namespace curve_segment_test {

FittedCurve circle_curve(double radius, double chord, int count) {
  geometry::Fitter fitter;
  FittedCurve fitted;
  EXPECT_TRUE(fitter.fit(test::circle_points(radius, chord, count), {}, {}, fitted.curve));
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

}  // namespace curve_segment_test
}  // namespace twin::path

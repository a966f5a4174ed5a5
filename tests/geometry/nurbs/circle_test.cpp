#include "geometry/nurbs/circle.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace twin::geometry {
namespace circle_test {

class CircleOfDegree : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Both, CircleOfDegree, ::testing::Values(2, 3));

TEST_P(CircleOfDegree, HasConstantRadius) {
  const Curve circle = *full_circle(Vec3::Zero(), 1.0, GetParam());
  EXPECT_EQ(circle.degree(), GetParam());
  for (int i = 0; i <= 10000; ++i) {
    ASSERT_NEAR(circle.position(i * 1e-4).norm(), 1.0, 1e-14);
    ASSERT_NEAR(circle.derivatives(i * 1e-4).position.norm(), 1.0, 1e-14);
  }
}

TEST_P(CircleOfDegree, HasConstantCurvatureAndTangentAcrossTheRadius) {
  const Vec3 centre(30, -20, 5);
  const Curve circle = *full_circle(centre, 12.5, GetParam());
  for (int i = 0; i <= 1000; ++i) {
    const Derivatives at = circle.derivatives(i * 1e-3);
    ASSERT_NEAR(curvature(at) * 12.5, 1.0, 1e-12);
    ASSERT_NEAR((at.position - centre).dot(at.first) / at.first.norm(), 0.0, 1e-12);
    ASSERT_NEAR(at.position.z(), 5.0, 1e-14);
  }
}

TEST_P(CircleOfDegree, RunsOnceAroundCounterClockwise) {
  const Curve circle = *full_circle(Vec3(1, 2, 0), 3.0, GetParam());
  EXPECT_LT((circle.position(0.0) - Vec3(4, 2, 0)).norm(), 1e-14);
  EXPECT_LT((circle.position(0.25) - Vec3(1, 5, 0)).norm(), 1e-14);
  EXPECT_LT((circle.position(0.5) - Vec3(-2, 2, 0)).norm(), 1e-14);
  EXPECT_LT((circle.position(0.75) - Vec3(1, -1, 0)).norm(), 1e-14);
  EXPECT_LT((circle.position(1.0) - Vec3(4, 2, 0)).norm(), 1e-14);
}

TEST(Circle, RefusesRadiusAndDegreeOutOfRange) {
  EXPECT_THAT(full_circle(Vec3::Zero(), 0.0).error().message, ::testing::HasSubstr("radius 0 mm"));
  EXPECT_FALSE(full_circle(Vec3::Zero(), -1.0));
  EXPECT_FALSE(full_circle(Vec3::Zero(), std::numeric_limits<double>::infinity()));
  EXPECT_THAT(full_circle(Vec3::Zero(), 1.0, 4).error().message, ::testing::HasSubstr("degree 4"));
}

}  // namespace circle_test
}  // namespace twin::geometry

#include "geometry/nurbs/curve.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "butterfly.hpp"
#include "naive.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace curve_test {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const std::vector<double> kKnots = {0, 0, 0, 1, 1, 1};
const std::vector<Vec3> kPoints = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};

TEST(Curve, CreateNamesWhatIsWrong) {
  const auto message = [](auto... arguments) {
    const auto curve = Curve::create(arguments...);
    return curve ? std::string() : to_string(curve.error());
  };
  EXPECT_EQ(message(2, kKnots, kPoints), "");
  EXPECT_THAT(message(2, std::vector<double>{0, 0, 1, 1}, kPoints), HasSubstr("4 knots where"));
  EXPECT_THAT(message(2, kKnots, kPoints, std::vector<double>{1, 1}),
              HasSubstr("2 weights for 3 control points"));
  EXPECT_THAT(message(2, kKnots, kPoints, std::vector<double>{1, 0, 1}),
              HasSubstr("weight 1 is 0, must be finite and above 0"));
  EXPECT_THAT(message(2, kKnots, kPoints, std::vector<double>{1, 1, -2}), HasSubstr("weight 2"));
  EXPECT_THAT(message(2, kKnots, kPoints, std::vector<double>{kNan, 1, 1}), HasSubstr("weight 0"));
  EXPECT_THAT(message(2, kKnots, kPoints, std::vector<double>{1, kInfinity, 1}),
              HasSubstr("weight 1"));
  EXPECT_THAT(message(2, kKnots, std::vector<Vec3>{{0, 0, 0}, {1, kNan, 0}, {1, 1, 0}}),
              HasSubstr("control point 1"));
}

TEST(Curve, WithEqualWeightsIsNotRational) {
  const Curve plain = *Curve::create(2, kKnots, kPoints);
  const Curve weighted = *Curve::create(2, kKnots, kPoints, {0.5, 0.5, 0.5});
  EXPECT_FALSE(weighted.is_rational());
  EXPECT_EQ(plain.position(0.3), weighted.position(0.3));
}

TEST(Curve, WithNearlyEqualWeightsIsNearlyTheBSpline) {
  test::RandomCurves random(3);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const Curve plain = random.curve(degree, 9, false);
    std::vector<double> weights(9, 2.0);
    weights[4] = std::nextafter(2.0, 3.0);
    const Curve rational =
        *Curve::create(degree, plain.knots(), plain.control_points(), std::move(weights));
    ASSERT_TRUE(rational.is_rational());
    for (double u = -1.0; u <= 2.0; u += 0.1) {
      const Derivatives a = plain.derivatives(u);
      const Derivatives b = rational.derivatives(u);
      EXPECT_LT((a.position - b.position).norm(), 1e-13);
      EXPECT_LT((a.first - b.first).norm(), 1e-12 * (1 + a.first.norm()) * 10);
      EXPECT_LT((a.second - b.second).norm(), 1e-11 * (1 + a.second.norm()) * 10);
    }
  }
}

TEST(Curve, BeginsAndEndsInItsFirstAndLastControlPoint) {
  test::RandomCurves random(4);
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    const Curve curve = random.curve(degree, degree + 5, true);
    EXPECT_LT((curve.position(curve.u_min()) - curve.control_points().front()).norm(), 1e-14);
    EXPECT_LT((curve.position(curve.u_max()) - curve.control_points().back()).norm(), 1e-14);
    EXPECT_LT((curve.derivatives(curve.u_max()).position - curve.control_points().back()).norm(),
              1e-14);
  }
}

TEST(Curve, ClampsAnyDoubleToItsDomain) {
  test::RandomCurves random(5);
  const Curve curve = random.curve(3, 9, true);
  for (const double u : {kNan, -kInfinity, -1e300, -1.0000001}) {
    EXPECT_EQ(curve.position(u), curve.position(-1.0));
    EXPECT_EQ(curve.derivatives(u).second, curve.derivatives(-1.0).second);
  }
  for (const double u : {kInfinity, 1e300, 2.0000001}) {
    EXPECT_EQ(curve.position(u, 3), curve.position(2.0));
    EXPECT_EQ(curve.derivatives(u, 99).second, curve.derivatives(2.0).second);
  }
}

TEST(Curve, IsTheLimitFromTheLeftAtItsEndAndFromTheRightAtKnots) {
  test::RandomCurves random(6);
  for (int round = 0; round < 50; ++round) {
    const Curve curve = random.curve(3, 9, round % 2 == 0);
    for (const double knot : curve.knots()) {
      const double inside = knot < 2.0 ? knot + 1e-9 : knot - 1e-9;
      const Derivatives at = curve.derivatives(knot);
      const Derivatives near = curve.derivatives(inside);
      EXPECT_LT((at.position - near.position).norm(), 1e-5);
      EXPECT_LT((at.first - near.first).norm(), 1e-4 * (1 + at.second.norm()));
    }
  }
}

TEST(Curve, HintsDoNotChangeTheResult) {
  test::RandomCurves random(7);
  const Curve curve = random.curve(3, 12, true);
  for (int hint = -2; hint < 20; ++hint) {
    const double u = random.uniform(-1, 2);
    EXPECT_EQ(curve.position(u, hint), curve.position(u));
    EXPECT_EQ(curve.derivatives(u, hint).second, curve.derivatives(u).second);
  }
}

TEST(Curve, MovesWithItsControlPoints) {  // affine invariance
  test::RandomCurves random(8);
  for (int round = 0; round < 100; ++round) {
    const Curve curve = random.curve(1 + round % kMaxDegree, 10, round % 2 == 0);
    Eigen::Matrix3d map;
    map << random.vector(2), random.vector(2), random.vector(2);
    const Vec3 shift = random.vector(5);
    std::vector<Vec3> mapped;
    for (const Vec3& p : curve.control_points()) {
      mapped.emplace_back(map * p + shift);
    }
    const Curve image = *Curve::create(curve.degree(), curve.knots(), mapped, curve.weights());
    const double u = random.uniform(-1, 2);
    const Derivatives a = curve.derivatives(u);
    const Derivatives b = image.derivatives(u);
    EXPECT_LT((map * a.position + shift - b.position).norm(), 1e-12);
    EXPECT_LT((map * a.first - b.first).norm(), 1e-12 * (1 + b.first.norm()) * 10);
    EXPECT_LT((map * a.second - b.second).norm(), 1e-11 * (1 + b.second.norm()) * 10);
  }
}

TEST(Butterfly, HasItsPublishedSmallestRadius) {
  const Curve curve = test::butterfly();
  const Derivatives at = curve.derivatives(0.25635);
  EXPECT_NEAR(1.0 / curvature(at), 0.0231, 5e-5);
  EXPECT_NEAR(at.position.x(), 84.943, 5e-4);
  EXPECT_NEAR(at.position.y(), 33.024, 5e-4);
  double greatest = 0.0;
  double where = 0.0;
  for (int i = 0; i <= 200000; ++i) {
    const double u = i / 200000.0;
    if (const double kappa = curvature(curve.derivatives(u)); kappa > greatest) {
      greatest = kappa;
      where = u;
    }
  }
  EXPECT_NEAR(1.0 / greatest, 0.0231, 5e-5);
  EXPECT_NEAR(std::min(where, 1.0 - where), 0.25635, 5e-5);  // it has two wings
}

}  // namespace curve_test

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

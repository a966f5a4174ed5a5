#include "geometry/nurbs/derivatives.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "naive.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace derivatives_test {

/// First and second derivative of f at u by central differences of fourth order with step h.
template <class F>
std::pair<Vec3, Vec3> differences(F f, double u, double h) {
  const Vec3 b2 = f(u - 2 * h);
  const Vec3 b1 = f(u - h);
  const Vec3 c = f(u);
  const Vec3 a1 = f(u + h);
  const Vec3 a2 = f(u + 2 * h);
  return {(b2 - 8 * b1 + 8 * a1 - a2) / (12 * h),
          (-b2 + 16 * b1 - 30 * c + 16 * a1 - a2) / (12 * h * h)};
}

TEST(Derivatives, AgreeWithFiniteDifferencesOfTheDefinition) {
  test::RandomCurves random(2);
  for (int round = 0; round < 400; ++round) {
    const int degree = 1 + round % kMaxDegree;
    const Curve curve = random.curve(degree, degree + 1 + round % 8, round % 2 == 0);
    const auto& knots = curve.knots();
    for (int s = degree; s + degree + 1 < static_cast<int>(knots.size()); ++s) {
      const double width = knots[s + 1] - knots[s];
      if (width < 1e-3) {
        continue;
      }
      const double u = knots[s] + width * random.uniform(0.2, 0.8);
      const auto naive = [&](double at) { return test::naive_position(curve, at); };
      const auto [first, second] = differences(naive, u, 0.004 * width);
      const Derivatives at = curve.derivatives(u);
      ASSERT_LT((at.position - naive(u)).norm(), 1e-12);
      ASSERT_LT((at.first - first).norm() * width, 5e-6) << "degree " << degree;
      ASSERT_LT((at.second - second).norm() * width * width, 5e-4) << "degree " << degree;
    }
  }
}

TEST(Derivatives, OfACubicBezierAreItsClosedForms) {
  const Vec3 a(1, 2, 3);
  const Vec3 b(4, -1, 0);
  const Vec3 c(2, 2, 5);
  const Vec3 d(-3, 7, 1);
  const Curve curve = *Curve::create(3, {0, 0, 0, 0, 1, 1, 1, 1}, {a, b, c, d});
  for (const double u : {0.0, 0.25, 0.6, 1.0}) {
    const double v = 1.0 - u;
    const Derivatives at = curve.derivatives(u);
    const Vec3 position = v * v * v * a + 3 * v * v * u * b + 3 * v * u * u * c + u * u * u * d;
    const Vec3 first = 3 * v * v * (b - a) + 6 * v * u * (c - b) + 3 * u * u * (d - c);
    const Vec3 second = 6 * v * (c - 2 * b + a) + 6 * u * (d - 2 * c + b);
    EXPECT_LT((at.position - position).norm(), 1e-14);
    EXPECT_LT((at.first - first).norm(), 1e-13);
    EXPECT_LT((at.second - second).norm(), 1e-12);
  }
}

TEST(Derivatives, OfARationalQuarterCircleAreItsClosedForms) {
  // Weights 1, 1, 2 on (1,0), (1,1), (0,1): C = ((1 - u^2), 2u) / (1 + u^2).
  const Curve curve =
      *Curve::create(2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, 1, 2});
  for (const double u : {0.0, 0.3, 0.5, 1.0}) {
    const double w = 1 + u * u;
    const Derivatives at = curve.derivatives(u);
    EXPECT_LT((at.position - Vec3((1 - u * u) / w, 2 * u / w, 0)).norm(), 1e-15);
    EXPECT_LT((at.first - Vec3(-4 * u, 2 - 2 * u * u, 0) / (w * w)).norm(), 1e-14);
    EXPECT_LT((at.second - Vec3(12 * u * u - 4, 4 * u * u * u - 12 * u, 0) / (w * w * w)).norm(),
              1e-13);
    EXPECT_NEAR(curvature(at), 1.0, 1e-13);
  }
}

TEST(Derivatives, SecondDerivativeOfDegreeOneIsZero) {
  const Curve curve = *Curve::create(1, {0, 0, 1, 3, 3}, {{0, 0, 0}, {1, 2, 3}, {5, 2, 3}});
  EXPECT_EQ(curve.derivatives(0.5).second, Vec3::Zero());
  EXPECT_EQ(curve.derivatives(0.5).first, Vec3(1, 2, 3));
  EXPECT_EQ(curve.derivatives(1.0).first, Vec3(2, 0, 0));
}

TEST(Curvature, IsZeroOnAStraightLineAndWhereTheTangentVanishes) {
  EXPECT_EQ(curvature({{0, 0, 0}, {2, 0, 0}, {7, 0, 0}}), 0.0);
  EXPECT_EQ(curvature({{0, 0, 0}, {0, 0, 0}, {1, 2, 3}}), 0.0);
}

TEST(Curvature, DoesNotDependOnTheParameter) {
  const Vec3 first(1, 2, -1);
  const Vec3 second(0.3, -2, 0.5);
  const double kappa = curvature({{}, first, second});
  // u = 3 v + v^2 at v = 0: dC/dv = 3 C', d2C/dv2 = 9 C'' + 2 C'.
  EXPECT_NEAR(curvature({{}, 3 * first, 9 * second + 2 * first}), kappa, 1e-15);
}

TEST(Curvature, OfAHelixIsItsClosedForm) {
  const double r = 2.0;
  const double c = 0.7;
  EXPECT_NEAR(curvature({{r, 0, 0}, {0, r, c}, {-r, 0, 0}}), r / (r * r + c * c), 1e-15);
}

}  // namespace derivatives_test
}  // namespace twin::geometry

#include "geometry/nurbs/bezier_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twin::geometry {
namespace bezier_fit_test {

/// Points of a circle of radius 2 mm in a tilted plane, unevenly spaced.
Vec3 on_circle(double angle) {
  return 2.0 * (std::cos(angle) * Vec3(0.6, 0.0, 0.8) + std::sin(angle) * Vec3(0.0, 1.0, 0.0));
}

std::vector<Vec3> circle_points() {
  std::vector<Vec3> points;
  double angle = 0.0;
  for (int i = 0; i < 24; ++i) {
    points.push_back(on_circle(angle));
    angle += i % 3 == 0 ? 0.07 : 0.15;
  }
  return points;
}

Curve fitted(std::span<const Vec3> points, BezierFitter& fitter, const EndCondition& begin = {},
             const EndCondition& end = {}) {
  Curve curve;
  EXPECT_EQ(fitter.fit(points, begin, end, curve), FitResult::kFitted);
  return curve;
}

TEST(BezierFit, PassesThroughEveryPointAtItsChordLength) {
  BezierFitter fitter;
  const auto points = circle_points();
  const Curve curve = fitted(points, fitter);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LT((curve.position(fitter.parameters()[i]) - points[i]).norm(), 1e-12);
  }
}

TEST(BezierFit, TangentsOfACirclesPointsAreTheCircles) {
  BezierFitter fitter;
  const auto points = circle_points();
  const Curve curve = fitted(points, fitter);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 tangent = curve.derivatives(fitter.parameters()[i]).first;
    EXPECT_NEAR(tangent.norm(), 1.0, 1e-12);
    EXPECT_NEAR(tangent.dot(points[i]), 0.0, 1e-12);
  }
}

TEST(BezierFit, TangentIsContinuousAndCurvatureIsNot) {
  BezierFitter fitter;
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) {
    points.push_back({0.3 * i, std::sin(0.5 * i), 0.0});
  }
  const Curve curve = fitted(points, fitter);
  double largest = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double u = fitter.parameters()[i];
    const Derivatives before = curve.derivatives(std::nextafter(u, 0.0));
    const Derivatives after = curve.derivatives(u);
    EXPECT_LT((before.first - after.first).norm(), 1e-9);
    largest = std::max(largest, (before.second - after.second).norm());
  }
  EXPECT_GT(largest, 1e-2);
}

TEST(BezierFit, EndsHaveTheGivenTangents) {
  BezierFitter fitter;
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}};
  const Vec3 up = Vec3(1, 0.1, 0).normalized();
  const Vec3 down = Vec3(1, -0.1, 0).normalized();
  const Curve curve = fitted(points, fitter, {true, up, Vec3::Zero()}, {true, down, Vec3::Zero()});
  EXPECT_LT((curve.derivatives(0.0).first - up).norm(), 1e-12);
  EXPECT_LT((curve.derivatives(1.0).first - down).norm(), 1e-12);
}

TEST(BezierFit, RefusesPointsThatCoincideOrAreTooFew) {
  BezierFitter fitter;
  Curve curve;
  EXPECT_EQ(fitter.fit(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, {}, {}, curve),
            FitResult::kTooFewPoints);
  EXPECT_EQ(fitter.fit(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}, {}, {}, curve),
            FitResult::kInvalidPoints);
  EXPECT_EQ(fitter.fit(std::vector<Vec3>{{0, 0, 0}}, {}, {}, curve), FitResult::kTooFewPoints);
  EXPECT_TRUE(curve.is_empty());
}

}  // namespace bezier_fit_test
}  // namespace twin::geometry

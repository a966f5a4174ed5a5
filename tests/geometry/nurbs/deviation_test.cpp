#include "geometry/nurbs/deviation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/nurbs/fit.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace deviation_test {

double distance_from_chord(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - along * (b - a)).norm();
}

/// Greatest distance found at `steps` places on each piece.
double sampled_deviation(const Curve& curve, const std::vector<Vec3>& points,
                         const std::vector<double>& parameters, int steps) {
  double greatest = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    for (int k = 0; k <= steps; ++k) {
      const double u = std::lerp(parameters[i - 1], parameters[i], static_cast<double>(k) / steps);
      greatest =
          std::max(greatest, distance_from_chord(curve.position(u), points[i - 1], points[i]));
    }
  }
  return greatest;
}

TEST(Deviation, BoundIsNeverBelowDenseSamples) {
  test::RandomCurves random(30);
  Fitter fitter;
  Curve curve;
  for (int round = 0; round < 1000; ++round) {
    const double turn = round % 3 == 0 ? 0.9 : 0.2;  // some runs double back
    const double smallest = round % 2 == 0 ? 0.01 : 0.3;
    std::vector<Vec3> points = {random.vector(50)};
    Vec3 direction = random.vector(1).normalized();
    for (int i = 0; i < 4 + round % 20; ++i) {
      direction = (direction + random.vector(turn)).normalized();
      points.emplace_back(points.back() + random.uniform(smallest, 1.0) * direction);
    }
    const EndCondition end{round % 5 == 0, random.vector(1), random.vector(3)};
    ASSERT_EQ(fitter.fit(points, end, {}, curve), FitResult::kFitted);
    const double bound = deviation_bound(curve, points, fitter.parameters());
    ASSERT_GE(bound, sampled_deviation(curve, points, fitter.parameters(), 200)) << round;
  }
}

TEST(Deviation, BoundIsWithinTenPercentOnSmoothRuns) {
  test::RandomCurves random(31);
  Fitter fitter;
  Curve curve;
  for (int round = 0; round < 200; ++round) {
    const double radius = random.uniform(1, 20);
    std::vector<Vec3> points;
    double angle = 0.0;
    for (int i = 0; i < 21; ++i) {
      points.emplace_back(radius * std::cos(angle), 0.7 * radius * std::sin(angle), 0.0);
      angle += random.uniform(0.07, 0.1);
    }
    ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
    const double sampled = sampled_deviation(curve, points, fitter.parameters(), 100);
    const double bound = deviation_bound(curve, points, fitter.parameters());
    ASSERT_GE(bound, sampled);
    ASSERT_LT(bound, 1.1 * sampled);
  }
}

TEST(Deviation, OfACircleIsItsSagitta) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) {
    points.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i), 0.0);
  }
  Fitter fitter;
  Curve curve;
  const EndCondition begin{true, Vec3::UnitY(), -Vec3::UnitX()};
  ASSERT_EQ(fitter.fit(points, begin, {}, curve), FitResult::kFitted);
  const double sagitta = 1.0 - std::cos(0.05);
  const double bound = deviation_bound(curve, points, fitter.parameters());
  EXPECT_GT(bound, sagitta);
  EXPECT_LT(bound, 1.08 * sagitta);
}

TEST(Deviation, OfAStraightRunIsZero) {
  const Vec3 direction = Vec3(1, 2, -2) / 3;
  std::vector<Vec3> points;
  for (const double l : {0.0, 0.3, 0.4, 0.41, 1.5, 6.0}) {
    points.emplace_back(Vec3(80, -20, 3) + l * direction);
  }
  Fitter fitter;
  Curve curve;
  ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
  EXPECT_LT(deviation_bound(curve, points, fitter.parameters()), 1e-10);
}

TEST(Deviation, CountsWhatRunsOutPastAnEndOfTheChord) {
  // The tangent prescribed at the beginning points away from the second point: the curve swings out
  // behind.
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}};
  const EndCondition backwards{true, {-3, 0, 0}, Vec3::Zero()};
  Fitter fitter;
  Curve curve;
  ASSERT_EQ(fitter.fit(points, backwards, {}, curve), FitResult::kFitted);
  const double sampled = sampled_deviation(curve, points, fitter.parameters(), 1000);
  EXPECT_GT(sampled, 0.1);
  EXPECT_GE(deviation_bound(curve, points, fitter.parameters()), sampled);
}

}  // namespace deviation_test
}  // namespace twin::geometry

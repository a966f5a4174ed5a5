#include "results/metrics/arc_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace twin::results {
namespace arc_steps_test {

// Steps of the whole trajectory; step q is that from point q to point q + 1.
std::vector<Step> steps_of(const std::vector<Vec3>& points) {
  ArcSteps arc_steps;
  arc_steps.reset(points.front());
  std::vector<Step> steps;
  for (std::size_t n = 1; n < points.size() + ArcSteps::kDelay - 1; ++n) {
    steps.push_back(arc_steps.push(points[std::min(n, points.size() - 1)]));
  }
  steps.erase(steps.begin(), steps.begin() + ArcSteps::kDelay - 1);
  return steps;
}

TEST(ArcSteps, CircleGivesItsArcs) {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(5 * std::cos(0.05 * i), 0.0, 5 * std::sin(0.05 * i));
  }
  const auto steps = steps_of(points);
  for (std::size_t q = 3; q + 3 < steps.size(); ++q) {
    EXPECT_NEAR(steps[q].arc, 0.25, 1e-12);
    EXPECT_NEAR(steps[q].chord, 10 * std::sin(0.025), 1e-12);
    EXPECT_NEAR(steps[q].bend, 0.05, 2e-5);
    EXPECT_LT(steps[q].doubt, 1e-12);
  }
}

TEST(ArcSteps, ArcOfAParabolaIsKnownToFourthOrder) {
  // arc length of y = x^2 / 2 from 0 to x
  const auto length = [](double x) { return 0.5 * (x * std::sqrt(1 + x * x) + std::asinh(x)); };
  double before = 0.0;
  for (const double h : {0.1, 0.05}) {
    std::vector<Vec3> points;
    for (int i = -10; i <= 10; ++i) {
      points.emplace_back(i * h, i * h * i * h / 2, 0.0);
    }
    const auto steps = steps_of(points);
    const double exact = length(h) - length(0.0);  // from point 10 to 11
    const double error = std::abs(steps[10].arc - exact);
    const double chord_error = std::abs(steps[10].chord - exact);
    EXPECT_LT(error, chord_error / 20);
    if (before > 0.0) {
      EXPECT_LT(error, before / 16);
    }
    before = error;
  }
}

TEST(ArcSteps, CornerInsideAPeriodIsDoubtful) {
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) {
    points.emplace_back(i, 0.0, 0.0);
  }
  points.emplace_back(
      9.5, 0.5, 0.0);  // the corner is at x = 9.5: the period's path is 1 long, its chord less
  for (int i = 1; i < 10; ++i) {
    points.emplace_back(9.5, 0.5 + i, 0.0);
  }
  const auto steps = steps_of(points);
  const double missing = 1.0 - steps[9].chord;
  EXPECT_GT(missing, 0.2);
  EXPECT_GE(steps[9].doubt, missing);
  EXPECT_LT(steps[5].doubt, 1e-12);
}

TEST(ArcSteps, StandingStillHasNeitherLengthNorDoubt) {
  for (const Step& step : steps_of(std::vector<Vec3>(20, Vec3(1, 2, 3)))) {
    EXPECT_EQ(step.arc, 0.0);
    EXPECT_EQ(step.doubt, 0.0);
  }
}

}  // namespace arc_steps_test
}  // namespace twin::results

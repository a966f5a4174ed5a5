#include "nc_programs/generate/bspline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nc_programs/generate/fair_curve.hpp"
#include "nc_programs/generate/rational_curve.hpp"

namespace twin::programs {
namespace bspline_test {

TEST(BSpline, WithoutInnerKnotsItIsTheBezierCurve) {
  const BSpline<2> c{3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 2}, {4, 0}}};
  for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const double r = 1.0 - t;
    const Point2 bernstein =
        3 * r * r * t * Point2(1, 2) + 3 * r * t * t * Point2(3, 2) + t * t * t * Point2(4, 0);
    EXPECT_NEAR((c.at(t) - bernstein).norm(), 0.0, 1e-14) << t;
  }
}

TEST(BSpline, DerivativeAgreesWithCentralDifferences) {
  const BSpline<2> c{
      3, {0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1}, {{0, 0}, {1, 2}, {3, 2}, {4, 0}, {5, -1}, {7, 1}}};
  const BSpline<2> d = c.derivative();
  const double h = 1e-5;
  for (const double t : {0.1, 0.35, 0.5, 0.65, 0.9}) {
    EXPECT_NEAR((d.at(t) - (c.at(t + h) - c.at(t - h)) / (2 * h)).norm(), 0.0, 1e-7) << t;
  }
}

TEST(FairCurve, PointsOfALineAreKeptWhateverTheSmoothing) {
  const FairCurve line({{0, 0}, {3, 4}, {6, 8}, {12, 16}}, 10.0);
  for (const double t : {0.0, 4.0, 11.0, 20.0}) {
    EXPECT_NEAR((line.at(t).point - t * Point2(0.6, 0.8)).norm(), 0.0, 1e-9) << t;
    EXPECT_NEAR(line.at(t).curvature, 0.0, 1e-9) << t;
  }
}

TEST(FairCurve, SmoothingTakesTheNoiseOutOfTheCurvatureOfACircle) {
  std::vector<Point2> sketch;
  for (int i = 0; i <= 12; ++i) {
    const double r = 20.0 + (i % 2 == 0 ? 0.05 : -0.05);
    sketch.emplace_back(r * std::cos(0.2 * i), r * std::sin(0.2 * i));
  }
  const auto unevenness = [&](double lambda) {
    const FairCurve c(sketch, lambda);
    double worst = 0.0;
    for (double f = 0.2; f <= 0.8; f += 0.01) {
      worst = std::max(worst, std::abs(c.at(f * c.end()).curvature - 0.05));
    }
    return worst;
  };
  EXPECT_GT(unevenness(1e-6), 0.02);
  EXPECT_LT(unevenness(100.0), 0.005);
}

TEST(FairCurve, ScalingDividesTheCurvature) {
  const FairCurve c({{0, 0}, {3, 2}, {6, 3}, {9, 2}}, 0.1);
  const FairCurve twice = c.scaled(2.0);
  const double t = 0.4 * c.end();
  EXPECT_NEAR(twice.at(t).curvature, 0.5 * c.at(t).curvature, 1e-14);
  EXPECT_NEAR((twice.at(t).point - 2.0 * c.at(t).point).norm(), 0.0, 1e-12);
}

TEST(RationalCurve, QuarterCircleHasTheRadiusEverywhere) {
  const double w = std::sqrt(0.5);
  const RationalCurve c(2, {{5, 0}, {5, 5}, {0, 5}}, {1, w, 1}, {0, 0, 0, 1, 1, 1});
  for (double u = 0.0; u <= 1.0; u += 0.05) {
    EXPECT_NEAR(c.at(u).point.norm(), 5.0, 1e-13) << u;
    EXPECT_NEAR(c.at(u).curvature, 0.2, 1e-12) << u;
  }
}

TEST(RationalCurve, ChordsOfACircleHaveTheLengthOfTheTolerance) {
  const double w = std::sqrt(0.5);
  const RationalCurve c(2, {{5, 0}, {5, 5}, {0, 5}}, {1, w, 1}, {0, 0, 0, 1, 1, 1});
  // chord 2 sqrt(2 r e) at sagitta e: 0.2 mm at 1 um, so 7.854 mm of arc take 40 chords
  EXPECT_EQ(linearise(c, 0.001, 1.0).size(), 41U);
}

}  // namespace bspline_test
}  // namespace twin::programs

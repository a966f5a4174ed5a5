#include "geometry/nurbs/arc_length.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "butterfly.hpp"
#include "geometry/gauss_legendre.hpp"
#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/fit.hpp"
#include "random_curve.hpp"

namespace twin::geometry {
namespace arc_length_test {

using std::numbers::pi;

/// Length of the polygon through 2^k points on each span, extrapolated twice (its error is a series
/// in h^2).
double romberg_length(const Curve& curve) {
  const auto polygon = [&](int steps) {
    double sum = 0.0;
    for (std::size_t s = 1; s < curve.knots().size(); ++s) {
      const double from = curve.knots()[s - 1];
      const double to = curve.knots()[s];
      Vec3 last = curve.position(from);
      for (int k = 1; k <= steps && from < to; ++k) {
        const Vec3 next = curve.position(std::lerp(from, to, static_cast<double>(k) / steps));
        sum += (next - last).norm();
        last = next;
      }
    }
    return sum;
  };
  const double a = polygon(256);
  const double b = polygon(512);
  const double c = polygon(1024);
  const double ab = b + (b - a) / 3;
  const double bc = c + (c - b) / 3;
  return bc + (bc - ab) / 15;
}

Curve random_fit(test::RandomCurves& random, int blocks, double turn) {
  std::vector<Vec3> points = {random.vector(20)};
  Vec3 direction = random.vector(1).normalized();
  for (int i = 0; i < blocks; ++i) {
    direction = (direction + random.vector(turn)).normalized();
    points.emplace_back(points.back() + random.uniform(0.05, 0.7) * direction);
  }
  Fitter fitter;
  Curve curve;
  EXPECT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
  return curve;
}

TEST(ArcLength, OfACircleIsRadiusTimesAngle) {
  for (const int degree : {2, 3}) {
    const double radius = 7.5;
    const Curve circle = *full_circle(Vec3(3, 4, 5), radius, degree);
    ArcLength arc;
    arc.build(circle);
    EXPECT_NEAR(arc.length(), 2 * pi * radius, 1e-9);
    for (double u = 0.0; u <= 1.0; u += 0.0037) {
      const Vec3 d = circle.position(u) - Vec3(3, 4, 5);
      const double angle = std::fmod(std::atan2(d.y(), d.x()) + 2 * pi, 2 * pi);
      EXPECT_NEAR(arc.s_at(circle, u), radius * angle, 1e-9);
      const Vec3 back = circle.position(arc.u_at(circle, radius * angle, 0.0));
      EXPECT_LT((back - circle.position(u)).norm(), 1e-9);
    }
  }
}

TEST(ArcLength, OfAParabolaIsItsClosedForm) {
  // C = (u, u^2) as a cubic, 0 <= u <= 3: s = u sqrt(1 + 4 u^2) / 2 + asinh(2 u) / 4.
  const Curve curve =
      *Curve::create(3, {0, 0, 0, 0, 3, 3, 3, 3}, {{0, 0, 0}, {1, 0, 0}, {2, 3, 0}, {3, 9, 0}});
  ArcLength arc;
  arc.build(curve);
  for (double u = 0.0; u < 3.1; u += 0.01) {
    const double v = std::min(u, 3.0);
    const double s = 0.5 * v * std::sqrt(1 + 4 * v * v) + 0.25 * std::asinh(2 * v);
    ASSERT_NEAR(arc.s_at(curve, u), s, 1e-9);
    ASSERT_NEAR(arc.u_at(curve, s, 0.0), v, 1e-9);
  }
}

TEST(ArcLength, OfTheButterflyIsThePublishedOne) {
  const Curve curve = test::butterfly();
  ArcLength arc;
  arc.build(curve);
  EXPECT_NEAR(arc.length(), 382.859558, 1e-5);
}

TEST(ArcLength, OfFittedCurvesAgreesWithExtrapolatedPolygons) {
  test::RandomCurves random(40);
  ArcLength arc;
  for (int round = 0; round < 30; ++round) {
    const Curve curve = random_fit(random, 3 + round, 0.3);
    arc.build(curve);
    ASSERT_NEAR(arc.length(), romberg_length(curve), 1e-8);
    ASSERT_NEAR(arc.s_at(curve, curve.u_max()), arc.length(), 0.0);
  }
}

TEST(ArcLength, OfAnyDegreeRationalOrNotAgreesWithExtrapolatedPolygons) {
  test::RandomCurves random(41);
  ArcLength arc;
  for (int degree = 1; degree <= kMaxDegree; ++degree) {
    for (const bool rational : {false, true}) {
      const Curve curve = random.curve(degree, degree + 4, rational);
      arc.build(curve);
      ASSERT_NEAR(arc.length() / romberg_length(curve), 1.0, 1e-7) << degree << rational;
    }
  }
}

TEST(ArcLength, AndItsInverseUndoEachOtherWhateverTheGuess) {
  test::RandomCurves random(42);
  ArcLength arc;
  std::vector<Curve> curves = {test::butterfly(), *full_circle(Vec3::Zero(), 2.0)};
  for (int i = 0; i < 40; ++i) {
    curves.push_back(random_fit(random, 3 + i, i % 2 == 0 ? 0.2 : 0.8));
    curves.push_back(random.curve(1 + i % kMaxDegree, 9, i % 3 == 0));
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Curve& curve : curves) {
    arc.build(curve);
    for (int i = 0; i < 200; ++i) {
      const double s = arc.length() * i / 199.0;
      const double guess = i % 10 == 0 ? nan : random.uniform(curve.u_min() - 1, curve.u_max() + 1);
      const double u = arc.u_at(curve, s, guess);
      ASSERT_NEAR(arc.s_at(curve, u), s, 1e-10) << curve.degree() << curve.is_rational();
    }
  }
}

TEST(ArcLength, InverseIsExactFromANearGuess) {
  test::RandomCurves random(43);
  const Curve curve = random_fit(random, 20, 0.2);
  ArcLength arc;
  arc.build(curve);
  for (double s = 0.0; s < arc.length(); s += 0.01) {
    const double far = arc.u_at(curve, s, 0.0);
    for (const double off : {1e-9, 1e-7, 1e-5, 1e-3}) {
      ASSERT_NEAR(arc.s_at(curve, arc.u_at(curve, s, far + off)), s, 1e-10);
    }
  }
}

TEST(ArcLength, ClampsToTheCurve) {
  const Curve circle = *full_circle(Vec3::Zero(), 1.0);
  ArcLength arc;
  arc.build(circle);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(arc.u_at(circle, -1.0, 0.5), 0.0);
  EXPECT_EQ(arc.u_at(circle, nan, 0.5), 0.0);
  EXPECT_EQ(arc.u_at(circle, 100.0, 0.5), 1.0);
  EXPECT_EQ(arc.s_at(circle, -1.0), 0.0);
  EXPECT_EQ(arc.s_at(circle, nan), 0.0);
  EXPECT_EQ(arc.s_at(circle, 2.0), arc.length());
}

TEST(ArcLength, SurvivesACuspAndAStandstill) {
  ArcLength arc;
  // (u^2, u^3)-like cusp in the middle of a span: C' = 0 at u = 1/2. Each half has length (13^1.5 -
  // 8) / 27 / 8 scaled.
  const Curve cusp =
      *Curve::create(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 0}});
  arc.build(cusp);
  EXPECT_TRUE(std::isfinite(arc.length()));
  EXPECT_NEAR(arc.s_at(cusp, arc.u_at(cusp, 0.5 * arc.length(), 0)), 0.5 * arc.length(), 1e-9);
  const Curve point =
      *Curve::create(3, {0, 0, 0, 0, 1, 1, 1, 1}, std::vector<Vec3>(4, Vec3(1, 2, 3)));
  std::vector<CurvatureSample> samples;
  arc.build(point, &samples);
  EXPECT_EQ(arc.length(), 0.0);
  EXPECT_EQ(arc.u_at(point, 0.0, 0.5), 0.0);
  for (const auto& sample : samples) {
    EXPECT_EQ(sample.curvature, 0.0);
  }
}

TEST(ArcLength, OfAStraightRunIsItsChords) {
  std::vector<Vec3> points;
  for (const double l : {0.0, 0.01, 5.01, 5.02, 10.0, 10.3}) {
    points.emplace_back(0.6 * l, 0.8 * l, 0.0);
  }
  Fitter fitter;
  Curve curve;
  ASSERT_EQ(fitter.fit(points, {}, {}, curve), FitResult::kFitted);
  ArcLength arc;
  arc.build(curve);
  EXPECT_NEAR(arc.length(), 10.3, 1e-12);
  EXPECT_NEAR(arc.s_at(curve, 5.015), 5.015, 1e-12);
}

TEST(CurvatureSamples, AreTheCurvaturesAtTheirPlaces) {
  test::RandomCurves random(44);
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  for (int round = 0; round < 60; ++round) {
    const Curve curve =
        round % 3 == 2 ? random.curve(3, 9, true) : random_fit(random, 3 + round, 0.25);
    arc.build(curve, &samples);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double kappa = curvature(curve.derivatives(samples[i].u));
      ASSERT_NEAR(samples[i].curvature, kappa, 1e-8 * (1 + kappa)) << round;
      ASSERT_NEAR(samples[i].s, arc.s_at(curve, samples[i].u), 1e-5 * (1 + arc.length()));
      ASSERT_TRUE(i == 0 || samples[i].u > samples[i - 1].u);
      ASSERT_TRUE(i == 0 || samples[i].s > samples[i - 1].s);
    }
    EXPECT_EQ(samples.front().s, 0.0);
    EXPECT_EQ(samples.back().s, arc.length());
    EXPECT_EQ(samples.back().u, curve.u_max());
  }
}

TEST(CurvatureSamples, IncludeEveryKnotAndThreePlacesBetween) {
  test::RandomCurves random(45);
  const Curve curve = random_fit(random, 20, 0.1);
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  arc.build(curve, &samples);
  for (std::size_t k = 3; k + 4 < curve.knots().size(); ++k) {
    const auto in_span = std::count_if(samples.begin(), samples.end(), [&](const auto& sample) {
      return sample.u >= curve.knots()[k] && sample.u < curve.knots()[k + 1];
    });
    EXPECT_GE(in_span, 4);
    EXPECT_TRUE(std::any_of(samples.begin(), samples.end(),
                            [&](const auto& sample) { return sample.u == curve.knots()[k]; }));
  }
}

TEST(CurvatureSamples, MissLittleOfTheGreatestCurvature) {
  test::RandomCurves random(46);
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  for (int round = 0; round < 100; ++round) {
    const Curve curve = random_fit(random, 20, 0.2);
    arc.build(curve, &samples);
    double sampled = 0.0;
    for (const auto& sample : samples) {
      sampled = std::max(sampled, sample.curvature);
    }
    double dense = 0.0;
    for (int i = 0; i <= 5000; ++i) {
      dense = std::max(dense, curvature(curve.derivatives(curve.u_max() * i / 5000)));
    }
    ASSERT_GT(sampled, 0.98 * dense);
  }
}

TEST(CurvatureSamples, FindTheTightPlacesOfTheButterfly) {
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  arc.build(test::butterfly(), &samples);
  double greatest = 0.0;
  for (const auto& sample : samples) {
    greatest = std::max(greatest, sample.curvature);
  }
  EXPECT_NEAR(1.0 / greatest, 0.0231, 0.0003);
}

using FivePoints = gauss::Rule<5>;

TEST(Gauss, QuarterWeightsIntegratePolynomialsUpToDegreeFour) {
  for (int degree = 0; degree <= 4; ++degree) {
    gauss::Values<5> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::pow(FivePoints::kNodes[i], degree);
    }
    for (std::size_t k = 0; k < FivePoints::kQuarters.size(); ++k) {
      const double exact =
          (std::pow(FivePoints::kQuarters[k], degree + 1) - std::pow(-1, degree + 1)) /
          (degree + 1);
      EXPECT_NEAR(gauss::weighted_sum(FivePoints::kQuarterWeights[k], values), exact, 1e-15);
    }
  }
}

TEST(Gauss, WeightsIntegratePolynomialsUpToDegreeNine) {
  for (int degree = 0; degree <= 9; ++degree) {
    gauss::Values<5> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::pow(FivePoints::kNodes[i], degree);
    }
    const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
    EXPECT_NEAR(gauss::weighted_sum(FivePoints::kWeights, values), exact, 1e-15);
  }
}

TEST(Gauss, FourWeightsIntegratePolynomialsUpToDegreeSeven) {
  for (int degree = 0; degree <= 7; ++degree) {
    gauss::Values<4> values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = std::pow(gauss::Rule<4>::kNodes[i], degree);
    }
    const double exact = degree % 2 == 0 ? 2.0 / (degree + 1) : 0.0;
    EXPECT_NEAR(gauss::weighted_sum(gauss::Rule<4>::kWeights, values), exact, 1e-15);
  }
}

}  // namespace arc_length_test
}  // namespace twin::geometry

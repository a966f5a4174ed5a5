#include "nc_programs/generate/programs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/support/nc_file.hpp"

namespace twin::programs {
namespace butterfly_test {

/// Length by Simpson's rule on every knot span [mm].
double length_of(const RationalCurve& curve) {
  double sum = 0.0;
  const auto& knots = curve.knots();
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const double h = (knots[i] - knots[i - 1]) / 400.0;
    for (int k = 0; k < 400 && h > 0.0; ++k) {
      const double u = knots[i - 1] + k * h;
      sum += h / 6.0 * (curve.speed(u) + 4.0 * curve.speed(u + 0.5 * h) + curve.speed(u + h));
    }
  }
  return sum;
}

TEST(Butterfly, CurveHasThePublishedLength) {
  EXPECT_NEAR(length_of(butterfly_curve()), 382.859558, 2e-6);
}

TEST(Butterfly, SmallestRadiusIsWhereAndWhatWasPublished) {
  const RationalCurve curve = butterfly_curve();
  double best = 0.0;
  double most = 0.0;
  for (int i = 0; i <= 50000; ++i) {  // one wing: the other is its mirror image
    const double kappa = std::abs(curve.at(i * 1e-5).curvature);
    if (kappa > most) {
      most = kappa;
      best = i * 1e-5;
    }
  }
  EXPECT_NEAR(best, 0.25635, 1e-5);
  EXPECT_NEAR(1.0 / most, 0.0231, 5e-5);
  EXPECT_NEAR((curve.point(0.25635) - Point2(84.943, 33.024)).norm(), 0.0, 1e-3);
}

TEST(Butterfly, ProgramIsALittleShorterThanTheCurve) {
  std::vector<Point2> p = test::polygon("butterfly.nc");
  EXPECT_EQ(p.back(), Point2::Zero());
  p.erase(p.begin());
  p.pop_back();
  const std::vector<double> l = test::lengths(p);
  const double sum = std::accumulate(l.begin(), l.end(), 0.0);
  EXPECT_LT(sum, 382.8596);
  EXPECT_GT(sum, 382.82);
  EXPECT_LE(*std::max_element(l.begin(), l.end()), 1.0002);
}

TEST(Butterfly, NoPointOfTheCurveIsFartherThanAMicrometreFromTheProgram) {
  const RationalCurve curve = butterfly_curve();
  std::vector<Point2> p = test::polygon("butterfly.nc");
  p.erase(p.begin());
  p.pop_back();
  const auto distance = [&](std::size_t k, const Point2& c) {
    const Point2 d = p[k + 1] - p[k];
    const double f = std::clamp((c - p[k]).dot(d) / d.squaredNorm(), 0.0, 1.0);
    return (c - p[k] - f * d).norm();
  };
  double worst = 0.0;
  std::size_t block = 0;  // walks along with the curve
  for (int i = 0; i <= 100000; ++i) {
    const Point2 c = curve.point(i * 1e-5);
    double best = distance(block, c);
    while (block + 2 < p.size() && distance(block + 1, c) <= best) {
      best = distance(++block, c);
    }
    worst = std::max(worst, best);
  }
  EXPECT_LE(worst, 0.001);
  EXPECT_GT(worst, 0.0008);  // and no finer than it has to be
}

}  // namespace butterfly_test
}  // namespace twin::programs

#include "studies/convert/uniform_refit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/nurbs/fit.hpp"

namespace twin::studies::convert {
namespace uniform_refit_test {

/// Curve through points of a wave at chords that grow and shrink.
geometry::Curve wave_curve() {
  std::vector<Vec3> points;
  double x = 0.0;
  for (int i = 0; i <= 20; ++i) {
    points.emplace_back(x, std::sin(x), 0.0);
    x += 0.2 + 0.15 * std::sin(1.7 * i);
  }
  geometry::Fitter fitter;
  geometry::Curve curve;
  EXPECT_EQ(fitter.fit(points, {}, {}, curve), geometry::FitResult::kFitted);
  return curve;
}

TEST(UniformRefit, IsNearAndUniform) {
  const geometry::Curve curve = wave_curve();
  EXPECT_FALSE(has_uniform_knots(curve));
  for (const double distance : {1e-2, 1e-3, 1e-4}) {
    const auto refit = uniform_refit(curve, distance, 100);
    ASSERT_TRUE(refit);
    EXPECT_TRUE(has_uniform_knots(*refit));
    EXPECT_EQ(refit->u_max(), curve.u_max());
    for (int i = 0; i <= 5000; ++i) {
      const double u = curve.u_max() * i / 5000.0;
      ASSERT_LT((refit->position(u) - curve.position(u)).norm(), 1.1 * distance) << u;
    }
  }
}

TEST(UniformRefit, TakesOverBothEndsWithTangentAndCurvature) {
  const geometry::Curve curve = wave_curve();
  const auto refit = uniform_refit(curve, 1e-3, 100);
  ASSERT_TRUE(refit);
  for (const double u : {0.0, curve.u_max()}) {
    const geometry::Derivatives a = curve.derivatives(u);
    const geometry::Derivatives b = refit->derivatives(u);
    EXPECT_LT((a.position - b.position).norm(), 1e-12);
    EXPECT_LT((a.first - b.first).norm(), 1e-9);
    EXPECT_LT((a.second - b.second).norm(), 1e-8);
  }
}

TEST(UniformRefit, TakesNoMoreSpansThanAllowed) {
  const geometry::Curve curve = wave_curve();
  EXPECT_FALSE(uniform_refit(curve, 1e-9, 6));
  const auto few = uniform_refit(curve, 1e-2, 100);
  const auto many = uniform_refit(curve, 1e-5, 100);
  ASSERT_TRUE(few && many);
  EXPECT_LT(few->control_points().size(), many->control_points().size());
}

TEST(UniformRefit, SeesUniformKnotsAtAnyScale) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {3, 1, 0}, {4, 0, 0}};
  const auto with = [&](double middle) {
    return *geometry::Curve::create(3, {2, 2, 2, 2, middle, 8, 8, 8, 8}, points);
  };
  EXPECT_TRUE(has_uniform_knots(with(5.0)));
  EXPECT_FALSE(has_uniform_knots(with(5.001)));
  EXPECT_FALSE(has_uniform_knots(*geometry::Curve::create(2, {0, 0, 0, 1, 1, 2, 2, 2}, points)));
}

}  // namespace uniform_refit_test
}  // namespace twin::studies::convert

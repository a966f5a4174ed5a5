#include <gtest/gtest.h>

#include <cmath>

#include "butterfly.hpp"
#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/deviation.hpp"
#include "geometry/nurbs/fit.hpp"
#include "tests/support/allocations.hpp"

namespace twin::geometry {
namespace {

template <class Call>
std::int64_t allocations_of(Call call) {
  const std::int64_t before = test::allocations();
  call();
  return test::allocations() - before;
}

TEST(Allocation, IsCountedHere) {
  EXPECT_GE(allocations_of([] { delete new std::vector<double>(100); }), 1);
}

TEST(Allocation, EvaluationNeedsNone) {
  const Curve curve = test::butterfly();
  ArcLength arc;
  arc.build(curve);
  double sum = 0.0;
  EXPECT_EQ(allocations_of([&] {
              for (int i = 0; i < 1000; ++i) {
                const double u = i * 1e-3;
                sum +=
                    curve.position(u).x() + curvature(curve.derivatives(u, curve.find_span(u, 5)));
                sum += arc.u_at(curve, arc.s_at(curve, u) + 0.01, u);
              }
            }),
            0);
  EXPECT_TRUE(std::isfinite(sum));
}

TEST(Allocation, FittingAgainNeedsNone) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) {
    points.emplace_back(std::cos(0.1 * i), std::sin(0.1 * i), 0.0);
  }
  Fitter fitter;
  Curve curve;
  ArcLength arc;
  std::vector<CurvatureSample> samples;
  const auto all = [&] {
    const EndCondition end = joint_condition(fitter, std::span(points).last(9), 8);
    fitter.fit(points, end, end, curve);
    deviation_bound(curve, points, fitter.parameters());
    arc.build(curve, &samples);
  };
  EXPECT_GT(allocations_of(all), 0);
  EXPECT_EQ(allocations_of(all), 0);
}

}  // namespace
}  // namespace twin::geometry

#include "motion/interpolator/parameter_update.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::motion {
namespace parameter_update_test {

/// A rational cubic whose speed |C'| changes by a factor of several along it.
geometry::Curve uneven_curve() {
  return geometry::Curve::create(3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1},
                                 {{0, 0, 0}, {1, 4, 0}, {6, 5, 1}, {9, 1, 2}, {16, 3, 0}},
                                 {1, 2, 0.5, 1.5, 1})
      .value();
}

/// Arc length from 0 to u by Simpson's rule on each side of the knot.
double measured_length(const geometry::Curve& curve, double u) {
  const auto part = [&](double from, double to) {
    constexpr int kSteps = 4000;
    double sum = 0.0;
    for (int i = 0; i <= kSteps; ++i) {
      const double weight = i == 0 || i == kSteps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
      const double at = i == kSteps ? to - 1e-15 : from + (to - from) * i / kSteps;
      sum += weight * curve.derivatives(at).first.norm();
    }
    return sum * (to - from) / (3.0 * kSteps);
  };
  return u <= 0.4 ? part(0.0, u) : part(0.0, 0.4) + part(0.4, u);
}

TEST(TaylorStep, ErrsByTheThirdPowerOfThePeriod) {
  const geometry::Curve curve = uneven_curve();
  geometry::ArcLength arc_length;
  arc_length.build(curve);
  for (const double u : {0.05, 0.2, 0.5, 0.7, 0.9}) {
    const double s = arc_length.s_at(curve, u);
    const auto error = [&](double period) {
      const double v = 50.0;
      const double a = -2000.0;
      const double exact = arc_length.u_at(curve, s + v * period + 0.5 * a * period * period, u);
      return std::abs(taylor_step(curve.derivatives(u), u, v, a, period) - exact);
    };
    EXPECT_NEAR(error(4e-3) / error(2e-3), 8.0, 2.5) << u;
    EXPECT_NEAR(error(2e-3) / error(1e-3), 8.0, 1.2) << u;
  }
}

TEST(TaylorStep, IsExactOnALineWithChordLengthAsParameter) {
  const geometry::Derivatives at{{1, 2, 3}, {0, 1, 0}, {0, 0, 0}};
  EXPECT_DOUBLE_EQ(taylor_step(at, 7.0, 50.0, 2000.0, 1e-3), 7.0 + 0.05 + 0.001);
}

TEST(TaylorStep, StaysWhereTheCurveHasNoPace) {
  EXPECT_EQ(taylor_step({{1, 2, 3}, Vec3::Zero(), {1, 0, 0}}, 0.3, 50.0, 0.0, 1e-3), 0.3);
}

TEST(CorrectedParameter, HitsTheArcLengthFromAnyPrediction) {
  const geometry::Curve curve = uneven_curve();
  geometry::ArcLength arc_length;
  arc_length.build(curve);
  for (double part = 0.0; part <= 1.0; part += 0.05) {
    const double s = part * arc_length.length();
    for (const double guess : {-1.0, 0.0, 0.39, 0.41, part, 1.0, 5.0}) {
      const double u = corrected_parameter(curve, arc_length, s, guess);
      EXPECT_NEAR(measured_length(curve, u), s, 1e-9);
    }
  }
}

}  // namespace parameter_update_test
}  // namespace twin::motion

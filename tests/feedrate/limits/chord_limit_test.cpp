#include "feedrate/limits/feedrate_rules.hpp"

#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace chord_limit_test {

constexpr double kPeriod = 4e-3;  // [s]

/// Distance of the middle of a chord from its arc, from three points of the circle.
double sagitta(const Vec3& a, const Vec3& b, const Vec3& middle_of_arc) {
  return (middle_of_arc - 0.5 * (a + b)).norm();
}

TEST(ChordLimit, AChordOfOnePeriodIsTheToleranceAwayFromTheCircle) {
  for (const double radius : {0.05, 1.0, 30.0}) {
    for (const double tolerance : {1e-4, 0.01, 0.049}) {
      const double chord = chord_error_feedrate(1.0 / radius, tolerance, kPeriod) * kPeriod;
      const double half_angle = std::asin(0.5 * chord / radius);
      const Vec3 a{radius * std::cos(half_angle), -0.5 * chord, 0.0};
      const Vec3 b{a.x(), 0.5 * chord, 0.0};
      EXPECT_NEAR(sagitta(a, b, {radius, 0.0, 0.0}), tolerance, 1e-12 * radius);
    }
  }
}

TEST(ChordLimit, IsInfiniteWhereNoChordLeavesTheTolerance) {
  EXPECT_TRUE(std::isinf(chord_error_feedrate(0.0, 0.01, kPeriod)));
  EXPECT_TRUE(std::isinf(chord_error_feedrate(100.0, 0.01, kPeriod)));
  EXPECT_TRUE(std::isfinite(chord_error_feedrate(99.0, 0.01, kPeriod)));
}

TEST(ChordLimit, BindsThePlannedFeedrateOnAnArc) {
  test::PlanSettings settings;
  settings.period = kPeriod;
  settings.model.feedrate_rule = FeedrateRule::kChordError;
  settings.path.chord_error = 0.001;
  constexpr double kRadius = 2.0;
  const auto planned =
      test::plan({test::arc_block({0, 0, 0}, {1, 0, 0}, kRadius, 5.0, true, 150.0)}, settings);
  test::expect_whole(planned, settings.limits);
  double fastest = 0.0;
  for (const Phase& phase : planned.segments.at(0).phases) {
    fastest = std::max(fastest, phase.v);
  }
  const auto& arc = std::get<path::Arc>(planned.segments.at(0).segment.geometry);
  const auto at = [&](double s) { return path::point_at(arc, s).position; };
  const double step = fastest * kPeriod;
  // The way along the arc is longer than its chord: less than 2/3 delta/rho of the tolerance.
  EXPECT_NEAR(sagitta(at(3.0), at(3.0 + step), at(3.0 + 0.5 * step)), 0.001, 0.001 * 0.001);
  EXPECT_LT(fastest, 40.0);
}

}  // namespace chord_limit_test
}  // namespace twin::feedrate

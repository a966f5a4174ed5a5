#include "feedrate/bound/time_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bound_of.hpp"
#include "tests/support/blocks.hpp"

namespace twin::feedrate {
namespace time_bound_test {

using test::arc_block;
using test::bound_of;
using test::dwell_block;
using test::line_block;
using test::PlanSettings;

constexpr double kA = 2450.0;  // acceleration limit [mm/s^2]
constexpr double kV = 50.0;    // programmed feedrate [mm/s]

/// Only A and the programmed feedrate limit: the servo model's error may be large.
PlanSettings without_servo_model() {
  PlanSettings settings;
  settings.model.circular_error = 1e6;
  settings.model.corner_error = 1e6;
  return settings;
}

/// Time of a line from v0 to v1 under V where there is room to reach it [s].
double ramp_time(double length, double v0, double v1) {
  const double distance = (2.0 * kV * kV - v0 * v0 - v1 * v1) / (2.0 * kA);
  return (2.0 * kV - v0 - v1) / kA + (length - distance) / kV;
}

TEST(TimeBound, ALineTakesItsTrapezoid) {
  EXPECT_NEAR(bound_of({line_block({0, 0, 0}, {60, 0, 0})}), 60.0 / kV + kV / kA, 1e-9);
}

TEST(TimeBound, ALineTooShortForItsFeedrateTakesItsTriangle) {
  EXPECT_NEAR(bound_of({line_block({0, 0, 0}, {0.4, 0.3, 0})}), 2.0 * std::sqrt(0.5 / kA), 1e-9);
}

TEST(TimeBound, ALineInPiecesTakesAsLongAsTheUncutLine) {
  for (const int count : {10, 2000, 20000}) {
    std::vector<Vec3> points;
    for (int i = 0; i <= count; ++i) {
      points.push_back(100.0 * i / count * Vec3(0.6, 0.8, 0.0));
    }
    EXPECT_NEAR(bound_of(test::polyline(points)), 100.0 / kV + kV / kA, 1e-6) << count;
  }
}

TEST(TimeBound, AnArcKeepsTheNormalAcceleration) {
  const double radius = 0.5;
  const double v = std::sqrt(kA * radius);
  const auto arc = arc_block({0, 0, 0}, {1, 0, 0}, radius, 1.5 * std::numbers::pi, true);
  const double length = 1.5 * std::numbers::pi * radius;
  EXPECT_NEAR(bound_of({arc}, without_servo_model()), length / v + v / kA, 1e-9);
}

TEST(TimeBound, AValleyBetweenTwoLinesTakesItsClosedForm) {
  const double radius = 0.5;
  const double v = std::sqrt(kA * radius);
  const auto before = line_block({-20, 0, 0}, {0, 0, 0});
  const auto arc = arc_block({0, 0, 0}, {1, 0, 0}, radius, 0.5 * std::numbers::pi, true);
  const auto after = line_block(arc.end, arc.end + Vec3(0, 30, 0));
  const double expected =
      ramp_time(20.0, 0.0, v) + 0.5 * std::numbers::pi * radius / v + ramp_time(30.0, v, 0.0);
  EXPECT_NEAR(bound_of({before, arc, after}, without_servo_model()), expected, 1e-9);
}

TEST(TimeBound, RestsAndDwellsCount) {
  const std::vector<gcode::Block> blocks{line_block({0, 0, 0}, {20, 0, 0}),
                                         dwell_block({20, 0, 0}, 0.25),
                                         line_block({20, 0, 0}, {50, 0, 0})};
  EXPECT_NEAR(bound_of(blocks), 50.0 / kV + 2.0 * kV / kA + 0.25, 1e-9);
}

TEST(TimeBound, ACornerIsPassedAtThePlannersOwnLimit) {
  const auto plan = test::plan(std::vector<gcode::Block>{line_block({0, 0, 0}, {20, 0, 0}),
                                                         line_block({20, 0, 0}, {20, 20, 0})});
  double corner = 0.0;
  for (const feedrate::LimitZone& zone : plan.segments[0].limits) {
    corner = zone.begin == zone.end ? zone.limit : corner;
  }
  ASSERT_GT(corner, 0.0);
  EXPECT_NEAR(bound_of(plan), ramp_time(20.0, 0.0, corner) + ramp_time(20.0, corner, 0.0), 1e-9);
}

TEST(JerkBound, ALineTakesItsSCurve) {
  const double ramp = std::sqrt(kV / 50000.0);
  const auto plan = test::plan({line_block({0, 0, 0}, {60, 0, 0})});
  EXPECT_NEAR(test::bounds_of(plan).with_jerk, 60.0 / kV + 2.0 * ramp, 1e-9);
  EXPECT_NEAR(plan.time, 60.0 / kV + 2.0 * ramp, 1e-9);
}

TEST(JerkBound, AnArcTakesItsSCurveToTheFeedrateOfItsCurvature) {
  const double radius = 0.5;
  const double v = std::sqrt(kA * radius);
  const auto arc = arc_block({0, 0, 0}, {1, 0, 0}, radius, 4.0 * std::numbers::pi, true);
  const PlanSettings settings = without_servo_model();
  EXPECT_NEAR(test::bounds_of(test::plan({arc}, settings), settings).with_jerk,
              4.0 * std::numbers::pi * radius / v + 2.0 * std::sqrt(v / 50000.0), 1e-9);
}

TEST(JerkBound, OfACornerIsWithinTwoPerMilleOfThePlan) {
  const auto plan = test::plan(std::vector<gcode::Block>{line_block({0, 0, 0}, {10, 0, 0}),
                                                         line_block({10, 0, 0}, {10, 10, 0})});
  const test::Bounds bounds = test::bounds_of(plan);
  EXPECT_LE(bounds.with_jerk, plan.time);
  EXPECT_GE(bounds.with_jerk, 0.998 * plan.time);
  EXPECT_LE(bounds.without_jerk, 0.92 * plan.time);
}

TEST(TimeBound, ItsProfileTakesTheTimeOfTheBound) {
  const auto points = test::circle_points(1.2, 0.1, 400);
  std::vector<test::At> profile;
  const double bound = bound_of(test::polyline(points), {}, &profile);
  double time = 0.0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double length = profile[i].s - profile[i - 1].s;
    time += length > 0.0 ? 2.0 * length / (profile[i].v + profile[i - 1].v) : 0.0;
  }
  EXPECT_NEAR(time, bound, 1e-9);
}

}  // namespace time_bound_test
}  // namespace twin::feedrate

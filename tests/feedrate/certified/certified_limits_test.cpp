#include "feedrate/certified/certified_limits.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "feedrate/limits/feedrate_rules.hpp"
#include "tests/support/blocks.hpp"
#include "tests/support/random_program.hpp"

namespace twin::feedrate {
namespace certified_limits_test {

using test::build;
using test::polyline;

path::PathPoint place(const path::FittedCurve& fitted, double s) {
  return path::point_from(fitted.curve.derivatives(fitted.arc_length.u_at(fitted.curve, s, 0.0)));
}

/// Calls f(curve, zone, place) for places between the samples of random fitted curves.
template <class F>
void for_places(const Limits& limits, const F& f) {
  std::mt19937 random(1);
  CertifiedLimits certified(limits, {}, {}, 1e-3);
  int curves = 0;
  for (int i = 0; i < 60; ++i) {
    for (const path::Segment& segment : build(test::random_program(random, 25))) {
      const auto* fitted = std::get_if<path::FittedCurve>(&segment.geometry);
      if (fitted == nullptr) {
        continue;
      }
      ++curves;
      std::vector<LimitZone> zones;
      certified.append(segment, 0.0, segment.feedrate, zones);
      ASSERT_EQ(zones.front().begin, 0.0);
      ASSERT_NEAR(zones.back().end, segment.length, 1e-9);
      for (const LimitZone& zone : zones) {
        for (const double part : {0.03, 0.31, 0.5, 0.77, 0.98}) {
          f(*fitted, zone, zone.begin + part * (zone.end - zone.begin));
        }
      }
    }
  }
  EXPECT_GT(curves, 50);
}

TEST(CertifiedLimits, NormalAccelerationIsKeptBetweenTheSamples) {
  Limits limits;
  limits.acceleration = 300.0;
  for_places(limits, [&](const path::FittedCurve& fitted, const LimitZone& zone, double s) {
    const double kappa = place(fitted, s).curvature.norm();
    EXPECT_LE(kappa * zone.limit * zone.limit, 300.0 * (1.0 + 1e-6));
  });
}

// The curvature of a quintic with knots close together has a narrow peak between its samples.
TEST(CertifiedLimits, NormalAccelerationIsKeptAtNarrowPeaksOfANurbs) {
  gcode::Block block;
  block.motion = gcode::Motion::kNurbs;
  block.feedrate = 20.0;
  block.nurbs = *gcode::make_programmed_curve(
      *geometry::Curve::create(5, {0, 0, 0, 0, 0, 0, 0.763858, 0.933567, 1, 1, 1, 1, 1, 1},
                               {{0, 0, 0},
                                {0.893677, 0, 0},
                                {1.486209, -0.669003, 0},
                                {2.17473, -1.238737, 0},
                                {2.147997, -2.132014, 0},
                                {1.72893, -2.921343, 0},
                                {0.963363, -3.382393, 0},
                                {0.25972, -3.933341, 0}},
                               {1, 0.02, 1, 1, 0.02, 1, 0.02, 1}));
  block.end = {0.25972, -3.933341, 0};
  Limits limits;
  limits.acceleration = 100.0;
  CertifiedLimits certified(limits, {}, {}, 1e-4);
  double nearest = 0.0;
  for (const path::Segment& segment : build({block})) {
    std::vector<LimitZone> zones;
    certified.append(segment, 0.0, 20.0, zones);
    const auto& curve = std::get<path::FittedCurve>(segment.geometry);
    for (const LimitZone& zone : zones) {
      for (int i = 0; i <= 50; ++i) {
        const double s = zone.begin + (zone.end - zone.begin) * i / 50;
        nearest =
            std::max(nearest, place(curve, s).curvature.norm() * zone.limit * zone.limit / 100.0);
      }
    }
  }
  EXPECT_LE(nearest, 1.0001);
  EXPECT_GE(nearest, 0.9);
}

TEST(CertifiedLimits, EveryAxisIsKeptBetweenTheSamplesByDifferencesOfThePath) {
  Limits limits;
  limits.axis_feedrate = {70.0, 90.0, 0.0};
  limits.axis_acceleration = {1500.0, 2000.0, 0.0};
  limits.axis_jerk = {60000.0, 40000.0, 0.0};
  for_places(limits, [&](const path::FittedCurve& fitted, const LimitZone& zone, double s) {
    const double h = 1e-6;
    if (zone.end - zone.begin < 100.0 * h) {
      return;  // too short for differences
    }
    const double low = std::max(s - h, 0.0);
    const double high = std::min(s + h, fitted.arc_length.length());
    const path::PathPoint at = place(fitted, s);
    const Vec3 twist =
        (place(fitted, high).curvature - place(fitted, low).curvature) / (high - low);
    const double speeding_up = std::min(zone.acceleration, limits.acceleration);
    const double braking = std::min(zone.deceleration, limits.acceleration);
    const double j = std::min(zone.jerk, limits.jerk);
    for (const double v : {0.5 * zone.limit, zone.limit}) {
      for (const double a : {speeding_up, 0.0, -braking}) {
        for (int i = 0; i < 2; ++i) {
          const double t = at.tangent[i];
          const double k = at.curvature[i];
          EXPECT_LE(std::abs(t) * v, limits.axis_feedrate[i] * (1.0 + 1e-6));
          EXPECT_LE(std::abs(t * a) + std::abs(k) * v * v,
                    limits.axis_acceleration[i] * (1.0 + 1e-6));
          EXPECT_LE(std::abs(t) * j + std::abs(3.0 * k * v * a + twist[i] * v * v * v),
                    limits.axis_jerk[i] * 1.001);
        }
      }
    }
  });
}

// The third derivative of a helix is larger than kappa^2: its axis turns with 1 / c^2.
TEST(CertifiedLimits, TheJerkOfAxesIsKeptOnASteepHelix) {
  Limits limits;
  limits.axis_jerk = {30000.0, 30000.0, 0.0};
  CertifiedLimits certified(limits, {}, {}, 1e-3);
  const auto segments = build({test::arc_block({0, 0, 0}, {1, 0, 0}, 0.1, 6.0, true, 50.0, 0.5)});
  const auto& arc = std::get<path::Arc>(segments.front().geometry);
  std::vector<LimitZone> zones;
  certified.append(segments.front(), 0.0, 50.0, zones);
  double largest = 0.0;
  for (const LimitZone& zone : zones) {
    const double s = 0.5 * (zone.begin + zone.end);
    const double h = 1e-6;
    const Vec3 twist =
        (path::point_at(arc, s + h).curvature - path::point_at(arc, s - h).curvature) / (2.0 * h);
    const double v = zone.limit;
    for (int i = 0; i < 2; ++i) {
      largest = std::max(largest, std::abs(path::point_at(arc, s).tangent[i]) * zone.jerk +
                                      std::abs(twist[i]) * v * v * v);
    }
  }
  EXPECT_LE(largest, 30000.0 * 1.001);
  EXPECT_GE(largest, 30000.0 * 0.5);
}

/// A square's corner of 90 degrees rounded by an arc of chords of this radius.
double lowest_limit_at_corner(double radius) {
  std::vector<Vec3> points{{-5, 0, 0}};
  for (int i = 0; i <= 24; ++i) {
    const double angle = std::numbers::pi / 2.0 * i / 24;
    points.emplace_back(radius * std::sin(angle), radius * (1.0 - std::cos(angle)), 0.0);
  }
  points.emplace_back(radius, radius + 5.0, 0.0);
  CertifiedLimits certified({}, {}, {}, 1e-3);
  double lowest = 1e9;
  for (const path::Segment& segment : build(polyline(points))) {
    std::vector<LimitZone> zones;
    certified.append(segment, 0.0, 50.0, zones);
    for (const LimitZone& zone : zones) {
      lowest = std::min(lowest, zone.limit);
    }
  }
  return lowest;
}

TEST(CertifiedLimits, CurvatureThatLastsIsHeldToTheCircularError) {
  // Far from a corner: (sqrt(2) - 1) 1 mm is 40 times the corner error.
  EXPECT_NEAR(lowest_limit_at_corner(1.0), servo_model_feedrate(1.0, {}), 3.0);
}

}  // namespace certified_limits_test
}  // namespace twin::feedrate

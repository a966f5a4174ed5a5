#include "feedrate/limits/feedrate_rules.hpp"

#include <gtest/gtest.h>

#include "tests/support/blocks.hpp"
#include "tests/support/plan.hpp"

namespace twin::feedrate {
namespace contact_limit_test {

constexpr double kProgrammed = 50.0;  // [mm/s]

/// A closed path in space that turns both ways and climbs.
Vec3 centre(double u) {
  const double r = 20.0 + 3.0 * std::cos(3.0 * u);
  return {r * std::cos(u), r * std::sin(u), 4.0 * std::sin(2.0 * u)};
}

Vec3 slope(const auto& f, double u) {
  constexpr double kStep = 1e-4;
  return (8.0 * (f(u + kStep) - f(u - kStep)) - (f(u + 2 * kStep) - f(u - 2 * kStep))) /
         (12.0 * kStep);
}

/// Where a vertical cylinder of radius r, its centre on the path, touches the surface.
Vec3 contact(double u, double radius, ToolSide side) {
  const Vec3 along = slope(centre, u);
  const Vec3 left = Vec3(-along.y(), along.x(), 0.0).normalized();
  return centre(u) + (side == ToolSide::kLeft ? -radius : radius) * left;
}

LocalGeometry place_at(double u) {
  const auto first = [](double x) { return slope(centre, x); };
  return local_geometry(path::point_from({centre(u), first(u), slope(first, u)}));
}

TEST(ContactLimit, ThePointOfContactMovesAtTheProgrammedFeedrate) {
  for (const ToolSide side : {ToolSide::kLeft, ToolSide::kRight}) {
    for (const double radius : {0.0, 0.5, 4.0}) {
      for (double u = 0.0; u < 6.28; u += 0.05) {
        const double v = contact_speed_feedrate(place_at(u), kProgrammed, radius, side);
        const double u_rate = v / slope(centre, u).norm();
        const auto touched = [&](double x) { return contact(x, radius, side); };
        EXPECT_NEAR(slope(touched, u).norm() * u_rate, kProgrammed, 1e-5) << u;
      }
    }
  }
}

TEST(ContactLimit, IsVNcTimesOneLessTheSurfacesCurvatureTimesTheRadius) {
  // A tool of radius 2 inside a round of radius 10 goes on a circle of 8, around one of 10 on 12.
  const LocalGeometry inside{1.0 / 8.0, 1.0, 1.0 / 8.0};
  EXPECT_NEAR(contact_speed_feedrate(inside, kProgrammed, 2.0, ToolSide::kLeft), 40.0, 1e-12);
  const LocalGeometry outside{1.0 / 12.0, 1.0, 1.0 / 12.0};
  EXPECT_NEAR(contact_speed_feedrate(outside, kProgrammed, 2.0, ToolSide::kRight), 60.0, 1e-12);
}

TEST(ContactLimit, LeavesTheProgrammedFeedrateWhereTheToolDoesNotFit) {
  for (const double radius : {1.0, 1.5, 100.0}) {  // around a corner on a circle of less than it
    EXPECT_EQ(contact_speed_feedrate({1.0, 1.0, -1.0}, kProgrammed, radius, ToolSide::kLeft),
              kProgrammed);
  }
}

TEST(ContactLimit, LeavesTheProgrammedFeedrateOnStraightAndVerticalWays) {
  EXPECT_EQ(contact_speed_feedrate({0.0, 0.3, 0.0}, kProgrammed, 5.0, ToolSide::kLeft),
            kProgrammed);
  const LocalGeometry up = local_geometry({Vec3::Zero(), Vec3::UnitZ(), {0.2, 0.0, 0.0}});
  EXPECT_EQ(contact_speed_feedrate(up, kProgrammed, 5.0, ToolSide::kLeft), kProgrammed);
}

double fastest(const PlannedSegment& planned) {
  double v = 0.0;
  for (const Phase& phase : planned.phases) {
    v = std::max(v, phase.v);
  }
  return v;
}

test::PlanSettings with_tool(double radius, ToolSide side) {
  test::PlanSettings settings;
  settings.path.planner = Planner::kPaper;
  settings.model.feedrate_rule = FeedrateRule::kContactSpeed;
  settings.model.tool_radius = radius;
  settings.model.tool_side = side;
  return settings;
}

TEST(ContactLimit, OfAnArcIsPlannedAboveAndBelowTheProgrammedFeedrate) {
  const auto settings = with_tool(4.0, ToolSide::kLeft);
  for (const bool is_left : {true, false}) {
    const auto planned = test::plan(
        {test::arc_block({0, 0, 0}, {1, 0, 0}, 12.0, 6.0, is_left, kProgrammed)}, settings);
    test::expect_whole(planned, settings.limits);
    EXPECT_NEAR(fastest(planned.segments.at(0)), is_left ? 37.5 : 75.0, 1e-6);
  }
}

TEST(ContactLimit, IsBoundedByTheLargestFeedrateAndTheNormalAcceleration) {
  auto settings = with_tool(11.5, ToolSide::kLeft);
  settings.limits.feedrate = 90.0;
  const auto block = test::arc_block({0, 0, 0}, {1, 0, 0}, 12.0, 6.0, false, kProgrammed);
  EXPECT_NEAR(fastest(test::plan({block}, settings).segments.at(0)), 90.0, 1e-6);
  settings.limits.acceleration = 400.0;
  EXPECT_NEAR(fastest(test::plan({block}, settings).segments.at(0)), std::sqrt(4800.0), 1e-6);
}

/// A fitted outline with inside and outside rounds of radius 2 and more.
std::vector<gcode::Block> outline() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) {
    const double a = 2.0 * std::numbers::pi * i / 400.0;
    const double r = 10.0 + 1.5 * std::cos(4.0 * a);
    points.emplace_back(r * std::cos(a), r * std::sin(a), 0.0);
  }
  return test::polyline(points, 20.0);
}

TEST(ContactLimit, OfFittedCurvesVariesAlongThem) {
  for (const ToolSide side : {ToolSide::kLeft, ToolSide::kRight}) {
    const auto settings = with_tool(1.0, side);
    const auto planned = test::plan(outline(), settings);
    test::expect_whole(planned, settings.limits);
    EXPECT_EQ(planned.fallbacks, 0);
    double closest = 0.0;  // contact speed by programmed feedrate
    double highest = 0.0;
    for (const PlannedSegment& segment : planned.segments) {
      highest = std::max(highest, fastest(segment));
      const auto& fitted = std::get<path::FittedCurve>(segment.segment.geometry);
      for (const Phase& phase : segment.phases) {
        const double u = fitted.arc_length.u_at(fitted.curve, phase.s, 0.0);
        const LocalGeometry at = local_geometry(path::point_from(fitted.curve.derivatives(u)));
        const double ratio = phase.v / contact_speed_feedrate(at, 20.0, 1.0, side);
        EXPECT_LE(ratio, 1.01);
        closest = std::max(closest, ratio);
      }
    }
    EXPECT_GT(closest, 0.98);
    EXPECT_GT(highest, 22.0);
  }
}

TEST(ContactLimit, OfAnArcOutsideTheXyPlaneFollowsItsSlope) {
  // A helix about the X axis: its projection into the XY plane is a sine.
  gcode::Block block = test::arc_block({0, 0, 0}, {1, 0, 0}, 5.0, 6.0, true, kProgrammed);
  block.arc.e1 = Vec3::UnitY();
  block.arc.e2 = Vec3::UnitZ();
  block.arc.rise = 40.0;
  std::vector<LimitZone> zones;
  const auto settings = with_tool(3.0, ToolSide::kLeft);
  const auto planned = test::plan({block}, settings);
  test::expect_whole(planned, settings.limits);
  double low = 1e9;
  double high = 0.0;
  for (const LimitZone& zone : planned.segments.at(0).limits) {
    low = std::min(low, zone.limit);
    high = std::max(high, zone.limit);
  }
  EXPECT_LT(low, 0.9 * kProgrammed);
  EXPECT_GT(high, 1.1 * kProgrammed);
}

}  // namespace contact_limit_test
}  // namespace twin::feedrate

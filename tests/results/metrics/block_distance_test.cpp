#include "results/metrics/block_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "blocks.hpp"
#include "gcode/block.hpp"
#include "geometry/nurbs/curve.hpp"
#include "results/metrics/contour_tracker.hpp"

namespace twin::results {
namespace block_distance_test {

constexpr double kPi = std::numbers::pi;

// The same by brute force: many points of the block.
double sampled(const gcode::Block& block, const Vec3& p, View view) {
  double best = 1e300;
  for (int i = 0; i <= 20000; ++i) {
    Vec3 d = point_at(block, i / 20000.0) - p;
    d.z() = view == View::kAlongZ ? 0.0 : d.z();
    best = std::min(best, d.norm());
  }
  return best;
}

TEST(BlockDistance, LineByTriangle345) {
  const gcode::Block block = line({0, 0, 0}, {10, 0, 0});
  EXPECT_DOUBLE_EQ(nearest(block, {4, 3, 4}, View::kSpace).distance, 5.0);
  EXPECT_DOUBLE_EQ(nearest(block, {4, 3, 4}, View::kAlongZ).distance, 3.0);
  EXPECT_DOUBLE_EQ(nearest(block, {4, 3, 4}, View::kSpace).fraction, 0.4);
  EXPECT_DOUBLE_EQ(nearest(block, {13, 4, 0}, View::kSpace).distance, 5.0);
  EXPECT_DOUBLE_EQ(nearest(block, {-3, 4, 0}, View::kSpace).fraction, 0.0);
  EXPECT_DOUBLE_EQ(nearest(block, {4, 0, 0}, View::kSpace, 0.6, 0.8).fraction, 0.6);
}

TEST(BlockDistance, LiftSeenAlongZIsAPoint) {
  const gcode::Block lift = line({1, 2, 0}, {1, 2, 30});
  EXPECT_DOUBLE_EQ(nearest(lift, {4, 6, 99}, View::kAlongZ).distance, 5.0);
  EXPECT_DOUBLE_EQ(block_length(lift, View::kAlongZ), 0.0);
  EXPECT_DOUBLE_EQ(block_length(lift, View::kSpace), 30.0);
}

TEST(BlockDistance, CircleIsRadiusLessDistanceFromItsCentre) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> radius(0.1, 40.0);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * kPi);
  for (double sense : {1.0, -1.0}) {
    const gcode::Block circle = arc({22, 3, 1}, {2, 3, 1}, {0, 0, sense}, 2.0 * kPi);
    for (int i = 0; i < 1000; ++i) {
      const double r = radius(random);
      const double a = angle(random);
      const Vec3 p(2 + r * std::cos(a), 3 + r * std::sin(a), 5);
      EXPECT_NEAR(nearest(circle, p, View::kAlongZ).distance, std::abs(r - 20.0), 1e-12);
      EXPECT_NEAR(nearest(circle, p, View::kSpace).distance, std::hypot(r - 20.0, 4.0), 1e-12);
    }
    EXPECT_NEAR(nearest(circle, {2, 3, 1}, View::kSpace).distance, 20.0, 1e-12);
  }
}

TEST(BlockDistance, BesideAnArcItsEndsAreNearest) {
  const gcode::Block quarter = arc({10, 0, 0}, {0, 0, 0}, {0, 0, 1}, kPi / 2);
  EXPECT_NEAR(nearest(quarter, {10, -3, 0}, View::kSpace).distance, 3.0, 1e-12);
  EXPECT_NEAR(nearest(quarter, {-4, 10, 0}, View::kSpace).distance, 4.0, 1e-12);
  EXPECT_NEAR(nearest(quarter, {-1, -1, 0}, View::kSpace).distance, std::hypot(11.0, 1.0), 1e-12);
}

TEST(BlockDistance, ArcsHelicesAndEllipsesAgreeWithManyPoints) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-6.0, 6.0);
  gcode::Block spiral = arc({3, 0, 0}, {0, 0, 0}, {0, 0, 1}, 4.0);
  spiral.arc.radius_change = 0.02;
  const gcode::Block blocks[] = {
      arc({3, 0, 0}, {0, 0, 0}, {0, 0, -1}, 5.0),
      arc({3, 0, 0}, {0, 0, 0}, {0, 0, 1}, 6.28, -4.0),
      arc({3, 0, -3}, {0, 0, -3}, {0, 0, 1}, 40.0, 6.0),
      arc({3, 0, 0}, {0, 0, 0}, {0, 1, 0}, 5.0),
      arc({0, 3, 0}, {0, 0, 0}, {1, 0, 1}, 6.0, 1.0),
      spiral,
  };
  for (const gcode::Block& block : blocks) {
    for (const View view : {View::kSpace, View::kAlongZ}) {
      for (int i = 0; i < 100; ++i) {
        const Vec3 p(x(random), x(random), x(random));
        const double exact = nearest(block, p, view).distance;
        const double coarse = sampled(block, p, view);
        EXPECT_LE(exact, coarse + 1e-12);
        EXPECT_GT(exact, coarse - 1e-3);
      }
    }
  }
}

TEST(BlockDistance, PlaceAndDistanceBelongTogether) {
  const gcode::Block helix = arc({3, 0, 0}, {0, 0, 0}, {0, 0, 1}, 6.0, -4.0);
  const Vec3 p(1, 2, -3);
  const NearestPoint place = nearest(helix, p, View::kSpace);
  EXPECT_NEAR((place.point - p).norm(), place.distance, 1e-12);
  EXPECT_NEAR((point_at(helix, place.fraction) - place.point).norm(), 0.0, 1e-12);
}

TEST(BlockDistance, LengthOfArcsInClosedForm) {
  const gcode::Block helix = arc({3, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2.0 * kPi, 4.0);
  EXPECT_NEAR(block_length(helix, View::kSpace), std::hypot(6.0 * kPi, 4.0), 1e-12);
  EXPECT_NEAR(block_length(helix, View::kAlongZ), 6.0 * kPi, 1e-12);
  EXPECT_GE(block_length(arc({3, 0, 0}, {0, 0, 0}, {0, 1, 0}, kPi), View::kAlongZ), 6.0);
}

TEST(BlockDistance, BlockAtRestIsItsPoint) {
  gcode::Block dwell = line({1, 1, 1}, {1, 1, 1});
  dwell.motion = gcode::Motion::kDwell;
  EXPECT_DOUBLE_EQ(nearest(dwell, {1, 4, 5}, View::kSpace).distance, 5.0);
  EXPECT_DOUBLE_EQ(block_length(dwell, View::kSpace), 0.0);
}

}  // namespace block_distance_test

namespace nurbs_distance_test {

using std::numbers::pi;

gcode::Block nurbs_block(geometry::Curve curve) {
  gcode::Block block;
  block.motion = gcode::Motion::kNurbs;
  block.start = curve.control_points().front();
  block.end = curve.control_points().back();
  block.nurbs = *gcode::make_programmed_curve(std::move(curve));
  return block;
}

/// Quarter of a circle of radius 5 about the origin, from X to Y, as a rational parabola.
gcode::Block quarter(double z = 0.0) {
  return nurbs_block(*geometry::Curve::create(
      2, {0, 0, 0, 1, 1, 1}, {{5, 0, 0}, {5, 5, 0.5 * z}, {0, 5, z}}, {1.0, std::sqrt(0.5), 1.0}));
}

TEST(NurbsDistance, FromACircleIsThatOfTheRadii) {
  const gcode::Block block = quarter();
  EXPECT_NEAR(block_length(block, View::kSpace), 2.5 * pi, 1e-9);
  for (const double radius : {0.5, 4.99, 5.00002, 7.0}) {
    for (int i = 0; i <= 20; ++i) {
      const double angle = 0.5 * pi * i / 20.0;
      const Vec3 point(radius * std::cos(angle), radius * std::sin(angle), 0.0);
      const NearestPoint place = nearest(block, point, View::kSpace);
      EXPECT_NEAR(place.distance, std::abs(radius - 5.0), 1e-12);
      EXPECT_NEAR(place.fraction, i / 20.0, 1e-9);
      EXPECT_LT((place.point - 5.0 / radius * point).norm(), 1e-8);
    }
  }
}

TEST(NurbsDistance, OfPlacesInARangeOnly) {
  const gcode::Block block = quarter();
  const NearestPoint place = nearest(block, {6.0, 0.0, 0.0}, View::kSpace, 0.5, 0.75);
  EXPECT_NEAR(place.fraction, 0.5, 1e-12);
  EXPECT_LT((place.point - Vec3(5.0 * std::sqrt(0.5), 5.0 * std::sqrt(0.5), 0.0)).norm(), 1e-9);
  EXPECT_NEAR(nearest(block, {0.0, 6.0, 0.0}, View::kSpace, 0.5, 0.75).fraction, 0.75, 1e-12);
}

TEST(NurbsDistance, SeenAlongZCountsXAndYOnly) {
  const gcode::Block block = quarter(3.0);
  const Vec3 above = point_at(block, 0.4) + Vec3(0.0, 0.0, 9.0);
  EXPECT_NEAR(nearest(block, above, View::kAlongZ).distance, 0.0, 1e-9);
  EXPECT_GT(nearest(block, above, View::kSpace).distance, 5.0);
  EXPECT_GE(block_length(block, View::kAlongZ), 2.5 * pi);
}

TEST(NurbsDistance, FractionIsThatOfTheArcLength) {
  const gcode::Block block = nurbs_block(*geometry::Curve::create(
      3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {2, 8, 0}, {9, 9, 0}}));
  double length = 0.0;
  Vec3 before = block.start;
  for (int i = 1; i <= 4000; ++i) {
    const Vec3 here = point_at(block, i / 4000.0);
    length += (here - before).norm();
    EXPECT_NEAR(length, block_length(block, View::kSpace) * i / 4000.0, 1e-4);
    before = here;
  }
  EXPECT_LT((point_at(block, 1.0) - block.end).norm(), 1e-12);
}

TEST(NurbsDistance, NearestOfManyPlacesIsFoundOnATightCurve) {
  const gcode::Block block = nurbs_block(
      *geometry::Curve::create(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3},
                               {{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {0, 1, 0}, {0, 2, 0}, {9, 2, 0}}));
  for (int i = 0; i < 400; ++i) {
    const Vec3 point(0.05 * (i % 20) * 10.0, 0.1 * (i / 20), 0.0);
    double least = 1e9;
    for (int k = 0; k <= 3000; ++k) {
      least = std::min(least, (block.nurbs->curve.position(0.001 * k) - point).norm());
    }
    const double found = nearest(block, point, View::kSpace).distance;
    EXPECT_LE(found, least + 1e-9);
    EXPECT_GE(found, least - 2e-2);
  }
}

TEST(NurbsDistance, TrackerFollowsItFromBlockToBlock) {
  ContourTracker tracker(View::kSpace);
  tracker.add(line({0, 0, 0}, {5, 0, 0}));
  tracker.add(quarter());
  tracker.add(line({0, 5, 0}, {-50, 5, 0}));
  for (int i = 0; i <= 200; ++i) {
    const double angle = 0.5 * pi * i / 200.0;
    const Vec3 command(5.0 * std::cos(angle), 5.0 * std::sin(angle), 0.0);
    tracker.follow(1, command);
    EXPECT_NEAR(tracker.nearest(1.004 * command).distance, 0.02, 1e-9);
  }
}

}  // namespace nurbs_distance_test
}  // namespace twin::results

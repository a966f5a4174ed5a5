#include "results/metrics/block_distance.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "blocks.hpp"

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
}  // namespace twin::results

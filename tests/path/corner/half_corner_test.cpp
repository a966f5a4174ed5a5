#include "path/corner/half_corner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace twin::path {
namespace half_corner_test {

CornerDemand demand(double turn_deg, double feedrate) {
  return {turn_deg * std::numbers::pi / 360.0, feedrate, 0.01, 2450.0, 50000.0};
}

// A reversal is one S-curve of one axis from +V to -V. From rest, with the acceleration sqrt(2 J V) that
// it has there, half of it takes sqrt(2 V / J) and goes 2/3 of V times that, so both lose 2/3
// sqrt(2 V / J). The tolerance lets it turn back e before the tip, which saves 2 e / V.
TEST(HalfCorner, AReversalIsOneSCurve) {
  for (const double feedrate : {10.0, 30.0, 50.0}) {
    const auto half = solve_half_corner(demand(179.9, feedrate));
    ASSERT_TRUE(half);
    const double loss = 2.0 / 3.0 * std::sqrt(2.0 * feedrate / 50000.0);
    EXPECT_GT(half->loss(), loss - 2.0 * 0.01 / feedrate - 1e-9) << feedrate;
    EXPECT_LT(half->loss(), 1.02 * loss) << feedrate;
  }
}

// Where A is reached, half a reversal from V = A^2 / J on begins with the constant acceleration A: it
// takes V / A + A / (2 J).
TEST(HalfCorner, AFastReversalHoldsTheAcceleration) {
  const auto half = solve_half_corner(demand(179.9, 200.0));
  ASSERT_TRUE(half);
  const double a = 2450.0, j = 50000.0, v = 200.0;
  const double time = v / a + 0.5 * a / j;
  const double hold = time - a / j;
  const double way = 0.5 * a * hold * hold + a * hold * (a / j) + a * a * a / (3.0 * j * j);
  EXPECT_NEAR(half->loss(), 2.0 * (time - way / v), 0.02 * 2.0 * (time - way / v));
  EXPECT_LE(half->acceleration, a * (1.0 + 1e-6));
}

// Losses of the free optimum within 10 um, F 50 mm/s, A 2450 mm/s^2 and J 50000 mm/s^3 as vectors: a
// linear program on 100 steps of time, solved apart.
TEST(HalfCorner, LosesNoMoreThanATwentiethMoreThanTheFreeOptimum) {
  for (const auto& [turn, best] : {std::pair{30.0, 32.1e-3},
                                   {60.0, 41.9e-3},
                                   {90.0, 40.1e-3},
                                   {120.0, 33.2e-3},
                                   {150.0, 29.4e-3},
                                   {172.0, 29.3e-3}}) {
    const auto half = solve_half_corner(demand(turn, 50.0));
    ASSERT_TRUE(half) << turn;
    EXPECT_LT(half->loss(), 1.06 * best) << turn;
    EXPECT_GT(half->loss(), 0.99 * best) << turn;
  }
  const auto gentle = solve_half_corner(demand(10.0, 50.0));
  ASSERT_TRUE(gentle);
  EXPECT_LT(gentle->loss(), 0.5e-3);
}

// The same where each axis has A and J for itself, and no limit is one of the vector; the bisector lies
// along an axis.
TEST(HalfCorner, WithLimitsOfEachAxisLosesNoMoreThanATenthMoreThanTheFreeOptimum) {
  for (const auto& [turn, best] : {std::pair{30.0, 25.0e-3},
                                   {60.0, 36.9e-3},
                                   {90.0, 36.5e-3},
                                   {120.0, 29.9e-3},
                                   {150.0, 28.4e-3},
                                   {172.0, 29.3e-3}}) {
    CornerDemand of_axes = demand(turn, 50.0);
    of_axes.acceleration = 1e5;
    of_axes.jerk = 1e9;
    of_axes.axes[0] = {Vec2(1.0, 0.0), 2450.0, 50000.0};
    of_axes.axes[1] = {Vec2(0.0, 1.0), 2450.0, 50000.0};
    const auto half = solve_half_corner(of_axes);
    ASSERT_TRUE(half) << turn;
    EXPECT_LT(half->loss(), 1.1 * best) << turn;
    EXPECT_GT(half->loss(), 0.98 * best) << turn;
    for (const HalfCorner::Node& node : half->nodes) {
      EXPECT_LE(node.jerk.cwiseAbs().maxCoeff(), 50000.0 * (1.0 + 1e-6)) << turn;
    }
  }
}

// The feedrate in the passage, by differences of the speed of 2,000 places.
TEST(HalfCorner, KeepsTheJerkAlongThePathWhereItIsLimited) {
  for (const double turn : {5.0, 14.0, 20.0, 30.0, 40.0}) {
    CornerDemand of_path = demand(turn, 50.0);
    of_path.jerk = 1e5;
    of_path.path_jerk = 50000.0;
    of_path.axes[0] = {Vec2(1.0, 0.0), 2450.0, 50000.0};
    of_path.axes[1] = {Vec2(0.0, 1.0), 2450.0, 50000.0};
    const auto half = solve_half_corner(of_path);
    ASSERT_TRUE(half) << turn;
    constexpr int kLooks = 250;  // of a piece
    const double h = half->duration / HalfCorner::kPieces / kLooks;
    std::vector<double> v;
    for (const HalfCorner::Node& node : half->nodes) {
      for (int k = 0; k < kLooks; ++k) {
        const double t = h * k;
        v.push_back((node.velocity + t * (node.acceleration + 0.5 * t * node.jerk)).norm());
      }
    }
    for (std::size_t i = 2; i < v.size(); ++i) {
      ASSERT_LE(std::abs(v[i] - 2.0 * v[i - 1] + v[i - 2]) / (h * h), 50000.0 * 1.002)
          << turn << " deg, place " << i;
    }
  }
}

// Two legs of 10 mm, F 50 mm/s, A 2450 mm/s^2 and J 50000 mm/s^3 of path and axes, and a curve in place of
// the passage: 23 ms at 10 degrees, 58 ms at 30 are lost.
TEST(HalfCorner, UnderTheJerkOfThePathLosesLessThanACurveAtGentleTurns) {
  for (const auto& [turn, most] : {std::pair{10.0, 1e-3}, {20.0, 20e-3}, {30.0, 40e-3}}) {
    CornerDemand of_path = demand(turn, 50.0);
    of_path.jerk = 1e5;
    of_path.path_jerk = 50000.0;
    of_path.axes[0] = {Vec2(1.0, 0.0), 2450.0, 50000.0};
    of_path.axes[1] = {Vec2(0.0, 1.0), 2450.0, 50000.0};
    const auto half = solve_half_corner(of_path);
    ASSERT_TRUE(half) << turn;
    EXPECT_LT(half->loss(), most) << turn;
  }
}

// An axis at 45 degrees to the bisector in the plane: both signs of its parts count, for the other half.
TEST(HalfCorner, BothHalvesKeepTheLimitsOfAnAxisThatLiesAtAnAngle) {
  CornerDemand askew = demand(80.0, 50.0);
  askew.jerk = 2e5;
  const double part = std::sqrt(0.5);
  askew.axes[0] = {Vec2(part, part), 1000.0, 30000.0};
  const auto half = solve_half_corner(askew);
  ASSERT_TRUE(half);
  double most = 0.0;
  double most_acceleration = 0.0;
  for (const HalfCorner::Node& node : half->nodes) {
    most = std::max(most, part * (std::abs(node.jerk.x()) + std::abs(node.jerk.y())));
    most_acceleration = std::max(most_acceleration, part * (std::abs(node.acceleration.x()) +
                                                            std::abs(node.acceleration.y())));
  }
  EXPECT_LE(most, 30000.0 * (1.0 + 1e-6));
  EXPECT_GT(most, 0.9 * 30000.0);
  EXPECT_LE(most_acceleration, 1000.0 * (1.0 + 1e-6));
}

// Ten times the length and the time that goes with it: the same shape.
TEST(HalfCorner, HasNoScaleOfItsOwn) {
  const auto one = solve_half_corner(demand(75.0, 40.0));
  const double k = 10.0;  // of lengths
  const double t = 3.0;   // of times
  const auto other = solve_half_corner({75.0 * std::numbers::pi / 360.0, 40.0 * k / t, 0.01 * k,
                                        2450.0 * k / (t * t), 50000.0 * k / (t * t * t)});
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(other->duration / one->duration, t, 1e-9);
  EXPECT_NEAR(other->way / one->way, k, 1e-5);
}

TEST(HalfCorner, IsThereAtAnyTurnAndFeedrate) {
  for (double feedrate = 0.5; feedrate < 250.0; feedrate *= 2.5) {
    for (const double turn : {0.05, 1.0, 7.0, 20.0, 45.0, 80.0, 110.0, 140.0, 170.0, 179.99}) {
      const auto half = solve_half_corner(demand(turn, feedrate));
      ASSERT_TRUE(half) << turn << " deg, " << feedrate << " mm/s";
      EXPECT_LE(half->deviation, 0.01 * (1.0 + 1e-6));
      EXPECT_LE(half->loss(), 2.5 * half->duration);
    }
  }
}

}  // namespace half_corner_test
}  // namespace twin::path

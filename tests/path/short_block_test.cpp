#include "path/short_block.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/units.hpp"

namespace twin::path {
namespace short_block_test {

constexpr double kPi = std::numbers::pi;

/// Kp / (1 - Kf) = 313.95 1/s, as Table 2 of the paper implies it.
PlanningModel table_2() { return {313.95, 0.0, 0.005, 0.01}; }

TEST(CriticalCornerAngle, IsThatOfTable2At3000MillimetresPerMinute) {
  const double angle = critical_corner_angle(50.0, 0.01, table_2());
  EXPECT_NEAR(units::deg_from_rad(angle), 172.8, 0.001);
}

TEST(CriticalCornerAngle, DependsOnTheGainsOnlyThroughKpOverOneLessKf) {
  const PlanningModel shipped;
  EXPECT_NEAR(shipped.kp / (1.0 - shipped.kf), 313.95, 0.005);
  const PlanningModel halves{0.5 * 313.95, 0.5, 0.005, 0.01};
  EXPECT_NEAR(critical_corner_angle(50.0, 0.01, halves),
              critical_corner_angle(50.0, 0.01, table_2()), 1e-12);
}

TEST(CriticalCornerAngle, IsZeroWhereTheArgumentOfAcosReachesOne) {
  EXPECT_EQ(critical_corner_angle(3.1395, 0.01, table_2()), 0.0);
  EXPECT_EQ(critical_corner_angle(1e-6, 0.01, table_2()), 0.0);
  EXPECT_GT(critical_corner_angle(3.14, 0.01, table_2()), 0.0);
}

TEST(CriticalCornerAngle, PutBackIntoEquation16GivesTheFeedrate) {
  for (double feedrate = 4.0; feedrate < 300.0; feedrate *= 1.3) {
    const double half = 0.5 * critical_corner_angle(feedrate, 0.01, table_2());
    EXPECT_NEAR(313.95 * 0.01 / std::cos(half), feedrate, 1e-9 * feedrate);
  }
}

TEST(CornerAngle, IsTheAngleBetweenTheTwoBlocks) {
  const Vec3 p(3.0, -2.0, 1.0);
  for (double turn = -3.1; turn < 3.1; turn += 0.1) {
    const Vec3 next = p + 0.3 * Vec3(std::cos(turn), std::sin(turn), 0.0);
    EXPECT_NEAR(corner_angle(p - Vec3(2.0, 0.0, 0.0), p, next), kPi - std::abs(turn), 1e-12);
  }
}

TEST(CornerAngle, ResolvesTurnsFarBelowTheRootOfTheRounding) {
  const double turn = 1e-10;
  const double angle = corner_angle({-1, 0, 0}, {0, 0, 0}, {std::cos(turn), std::sin(turn), 0});
  EXPECT_NEAR(kPi - angle, turn, 1e-15);
}

TEST(BiChordError, IsTheSagittaOfTheLongerChordOfACircle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double radius = std::pow(10.0, -1.0 + 4.0 * part(random));
    const double first = 0.01 + 0.7 * part(random);  // angles seen from the centre
    const double second = 0.01 + 0.7 * part(random);
    const auto on = [&](double a) { return Vec3(radius * std::cos(a), radius * std::sin(a), 7.0); };
    const double sagitta = radius * (1.0 - std::cos(0.5 * std::max(first, second)));
    EXPECT_NEAR(bi_chord_error(on(0.0), on(first), on(first + second)), sagitta, 1e-9 * sagitta);
  }
}

TEST(BiChordError, IsNothingOnAStraightLine) {
  EXPECT_EQ(bi_chord_error({0, 0, 0}, {1, 2, 3}, {3, 6, 9}), 0.0);
}

TEST(BiChordError, IsInfiniteWhereThePathTurnsByARightAngleOrMore) {
  EXPECT_TRUE(std::isinf(bi_chord_error({0, 0, 0}, {1, 0, 0}, {1, 1, 0})));
  EXPECT_TRUE(std::isinf(bi_chord_error({0, 0, 0}, {1, 0, 0}, {0, 0, 0})));
  EXPECT_TRUE(std::isfinite(bi_chord_error({0, 0, 0}, {1, 0, 0}, {1.01, 1, 0})));
}

TEST(BiChordError, IsTheSameInBothDirections) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(1, 0.1, 0);
  const Vec3 c(1.4, 0.3, 0.2);
  EXPECT_DOUBLE_EQ(bi_chord_error(a, b, c), bi_chord_error(c, b, a));
}

TEST(BiChordError, IsWithinAToleranceWhereItIsAtMostThat) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> any(-1.0, 1.0);
  int within = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p0(any(random), any(random), any(random));
    const Vec3 p1 = p0 + Vec3(1.0, 0.3 * any(random), 0.0);
    const Vec3 p2 = p1 + std::pow(10.0, any(random)) * Vec3(1.0, any(random), 0.1 * any(random));
    const double error = bi_chord_error(p0, p1, p2);
    const double tolerance =
        error * (1.0 + std::pow(10.0, -4.0 + 4.0 * any(random)) * (i % 2 == 0 ? 1.0 : -0.5));
    ASSERT_EQ(is_bi_chord_within(p0, p1, p2, tolerance), error <= tolerance) << i;
    within += error <= tolerance ? 1 : 0;
  }
  EXPECT_GT(within, 5000);
}

}  // namespace short_block_test
}  // namespace twin::path

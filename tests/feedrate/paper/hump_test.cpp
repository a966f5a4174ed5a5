#include "feedrate/paper/hump.hpp"

#include <gtest/gtest.h>

#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace hump_test {

using test::log_uniform;

constexpr RampLimits kTable2{2450.0, 50000.0};

struct Case {
  Anchor a;
  Anchor b;
  double cap;
  RampLimits limits;
};

/// Random anchors of which each can be reached from the other.
Case random_case(std::mt19937& random) {
  Case c;
  c.limits = test::random_limits(random);
  c.a.s = log_uniform(random, 1e-3, 100.0);
  c.a.v = random() % 4 == 0 ? 0.0 : log_uniform(random, 0.01, 300.0);
  const double d = log_uniform(random, 1e-4, 300.0);
  c.b.s = c.a.s + d;
  const double most = ramp_reach(c.a.v, d, c.limits);
  c.b.v = c.a.v + (most - c.a.v) * std::uniform_real_distribution<double>(0.0, 0.999)(random);
  if (random() % 2 == 0) {
    std::swap(c.a.v, c.b.v);
  }
  c.cap = std::max(c.a.v, c.b.v) * log_uniform(random, 1.0, 10.0) + 0.01;
  return c;
}

TEST(Hump, FillsTheWayBetweenItsKnots) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Case c = random_case(random);
    const Hump hump = make_hump(c.a, c.b, c.cap, c.limits);
    const double d = c.b.s - c.a.s;
    ASSERT_GE(hump.up, 0.0);
    ASSERT_GE(hump.down, 0.0);
    ASSERT_LE(hump.up + hump.down, d * (1.0 + 1e-12));
    ASSERT_GE(hump.peak, std::max(c.a.v, c.b.v));
    ASSERT_LE(hump.peak, c.cap);
  }
}

TEST(Hump, IsTheFastestUnderItsCap) {
  std::mt19937 random(2);
  std::size_t below_cap = 0;
  for (int i = 0; i < 20000; ++i) {
    const Case c = random_case(random);
    const Hump hump = make_hump(c.a, c.b, c.cap, c.limits);
    if (hump.peak == c.cap) {
      continue;
    }
    // Not at its cap: a peak higher by a millionth would not fit.
    ++below_cap;
    const double higher = hump.peak * (1.0 + 1e-6);
    ASSERT_GT(ramp_distance(c.a.v, higher, c.limits) + ramp_distance(higher, c.b.v, c.limits),
              c.b.s - c.a.s);
    ASSERT_NEAR(hump.up + hump.down, c.b.s - c.a.s, 1e-9 * (c.b.s - c.a.s));
  }
  EXPECT_GT(below_cap, 5000U);
}

TEST(Hump, HasTheClosedFormOfRestToRest) {
  // 2 v sqrt(v/J) = d without constant acceleration: d = 1 mm, v = (d sqrt(J) / 2)^(2/3).
  const Hump hump = make_hump({0, 0}, {1, 0}, 1000.0, kTable2);
  EXPECT_NEAR(hump.peak, std::pow(0.5 * std::sqrt(50000.0), 2.0 / 3.0), 1e-9);
  EXPECT_NEAR(hump.up, 0.5, 1e-12);
  EXPECT_NEAR(hump.down, 0.5, 1e-12);
}

TEST(Hump, BetweenKnotsAtTheCapIsAHold) {
  const Hump hump = make_hump({2, 50}, {7, 50}, 50.0, kTable2);
  EXPECT_EQ(hump.peak, 50.0);
  EXPECT_EQ(hump.up, 0.0);
  EXPECT_EQ(hump.down, 0.0);
}

TEST(Hump, IsReachableExactlyWhereTheRampFits) {
  const double d = ramp_distance(10.0, 40.0, kTable2);
  EXPECT_TRUE(is_reachable({0, 10}, {d, 40}, kTable2));
  EXPECT_TRUE(is_reachable({0, 40}, {d, 10}, kTable2));
  EXPECT_FALSE(is_reachable({0, 10}, {d - 1e-6, 40}, kTable2));
  EXPECT_FALSE(is_reachable({0, 40}, {d - 1e-6, 10}, kTable2));
}

TEST(FasterThan, IsEmptyAtThePeakAndAllBelowTheEnds) {
  const Hump hump = make_hump({1, 20}, {9, 30}, 60.0, kTable2);
  const Interval none = faster_than(hump, 60.0, kTable2);
  EXPECT_GE(none.begin, none.end);
  const Interval all = faster_than(hump, 10.0, kTable2);
  EXPECT_EQ(all.begin, 1.0);
  EXPECT_EQ(all.end, 9.0);
}

TEST(FasterThan, EndsWhereTheIntegratedRampsPassTheFeedrate) {
  const Hump hump = make_hump({1, 20}, {30, 0}, 180.0, kTable2);
  const test::SCurve up(hump.peak - 20.0, kTable2);
  const test::SCurve down(hump.peak, kTable2);
  for (const double v : {25.0, 60.0, 110.0, 150.0}) {
    const Interval fast = faster_than(hump, v, kTable2);
    EXPECT_NEAR(fast.begin, 1.0 + up.distance_until(20.0, v), 1e-5);
    EXPECT_NEAR(fast.end, 30.0 - down.distance_until(0.0, v), 1e-5);
  }
}

}  // namespace hump_test
}  // namespace twin::feedrate

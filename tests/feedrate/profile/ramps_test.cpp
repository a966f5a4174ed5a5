#include "feedrate/profile/ramps.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace ramps_test {

using test::log_uniform;
using test::SCurve;

constexpr RampLimits kTable2{2450.0, 50000.0};  // A is reached from a change of 120 mm/s on

struct Change {
  double v1;
  double v2;
  RampLimits limits;
};

/// Changes with and without a phase of constant acceleration, about half each.
std::vector<Change> changes() {
  std::vector<Change> all{{0, 50, kTable2},    {0, 120.05, kTable2}, {0, 200, kTable2},
                          {30, 180, kTable2},  {50, 51, kTable2},    {199, 200, kTable2},
                          {10, 1000, kTable2}, {0, 1e-3, kTable2}};
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const double v1 = i % 5 == 0 ? 0.0 : log_uniform(random, 1e-2, 300.0);
    all.push_back({v1, v1 + log_uniform(random, 1e-2, 500.0), test::random_limits(random)});
  }
  return all;
}

bool holds_acceleration(const Change& c) {
  return (c.v2 - c.v1) * c.limits.jerk > c.limits.acceleration * c.limits.acceleration;
}

TEST(Ramp, IsTestedWithAndWithoutConstantAcceleration) {
  const auto all = changes();
  const auto with = std::count_if(all.begin(), all.end(), holds_acceleration);
  EXPECT_GT(with, 15);
  EXPECT_GT(static_cast<std::ptrdiff_t>(all.size()) - with, 15);
}

TEST(Ramp, TakesTheTimeOfTheIntegratedSCurve) {
  for (const Change& c : changes()) {
    const double tau = SCurve(c.v2 - c.v1, c.limits).duration();
    EXPECT_NEAR(ramp_time(c.v2 - c.v1, c.limits), tau, 1e-9 * tau);
    EXPECT_EQ(ramp_time(c.v1 - c.v2, c.limits), ramp_time(c.v2 - c.v1, c.limits));
  }
}

TEST(Ramp, CoversTheDistanceOfTheIntegratedSCurve) {
  for (const Change& c : changes()) {
    const double d = SCurve(c.v2 - c.v1, c.limits).distance_until(c.v1, 1e9);
    EXPECT_NEAR(ramp_distance(c.v1, c.v2, c.limits), d, 1e-7 * d);
    EXPECT_DOUBLE_EQ(ramp_distance(c.v2, c.v1, c.limits), ramp_distance(c.v1, c.v2, c.limits));
  }
}

TEST(Ramp, CoversTheDistanceUntilAFeedrateOfTheIntegratedSCurve) {
  for (const Change& c : changes()) {
    const SCurve curve(c.v2 - c.v1, c.limits);
    const double whole = ramp_distance(c.v1, c.v2, c.limits);
    for (const double part : {0.0, 0.01, 0.2, 0.5, 0.77, 0.99, 1.0}) {
      const double v = c.v1 + part * (c.v2 - c.v1);
      EXPECT_NEAR(ramp_distance_until(c.v1, c.v2, v, c.limits), curve.distance_until(c.v1, v),
                  2e-6 * whole);
    }
  }
}

TEST(Ramp, UntilItsEndsIsNothingAndAll) {
  for (const Change& c : changes()) {
    const double whole = ramp_distance(c.v1, c.v2, c.limits);
    EXPECT_EQ(ramp_distance_until(c.v1, c.v2, c.v1, c.limits), 0.0);
    EXPECT_NEAR(ramp_distance_until(c.v1, c.v2, c.v2, c.limits), whole, 1e-12 * whole);
  }
}

TEST(Ramp, ReachesTheFeedrateWhoseRampFillsTheDistance) {
  for (const Change& c : changes()) {
    const double d = SCurve(c.v2 - c.v1, c.limits).distance_until(c.v1, 1e9);
    EXPECT_NEAR(ramp_reach(c.v1, d, c.limits), c.v2, 1e-6 * c.v2);
  }
}

TEST(Ramp, ReachesNothingMoreInNoDistance) {
  EXPECT_EQ(ramp_reach(30.0, 0.0, kTable2), 30.0);
  EXPECT_EQ(ramp_reach(30.0, -1.0, kTable2), 30.0);
  EXPECT_EQ(ramp_reach(0.0, 0.0, kTable2), 0.0);
}

TEST(Ramp, ReachOfAnyDistanceFitsIntoIt) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const RampLimits limits = test::random_limits(random);
    const double v1 = i % 7 == 0 ? 0.0 : log_uniform(random, 1e-6, 500.0);
    const double d = log_uniform(random, 1e-9, 1e3);
    const double v2 = ramp_reach(v1, d, limits);
    ASSERT_GE(v2, v1);
    // v2 is right to the last digits; where v1 is large, a ramp of that little has some length.
    constexpr double kDigits = 8.0 * std::numeric_limits<double>::epsilon();
    ASSERT_LE(ramp_distance(v1, std::max(v1, v2 * (1.0 - kDigits)), limits), d * (1.0 + 1e-12));
    ASSERT_GE(ramp_distance(v1, v2 * (1.0 + kDigits), limits), d * (1.0 - 1e-12));
  }
}

TEST(Ramp, StartAndStopAt3000MillimetresPerMinuteLoseTheRootOfVOverJ) {
  // paper/notes: one start or stop loses sqrt(V/J) = 0.0316 s against constant speed.
  const double lost = ramp_time(50.0, kTable2) - ramp_distance(0.0, 50.0, kTable2) / 50.0;
  EXPECT_NEAR(lost, 0.0316, 0.00005);
}

}  // namespace ramps_test
}  // namespace twin::feedrate

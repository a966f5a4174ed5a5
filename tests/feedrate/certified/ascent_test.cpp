#include "feedrate/certified/ascent.hpp"

#include <gtest/gtest.h>

#include "tests/feedrate/lattice_optimum.hpp"
#include "tests/support/random_zones.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace ascent_test {

using test::log_uniform;

constexpr RampLimits kTable2{2450.0, 50000.0};

Ascent whole(const std::vector<LimitZone>& zones, const RampLimits& ramp, double v = 0.0) {
  Ascent ascent;
  ascent.start(zones, 0, {0.0, v}, Sense::kForward, ramp, zones.back().limit);
  for (int i = 0; i < 10000 && !ascent.is_complete(); ++i) {
    ascent.extend();
  }
  EXPECT_TRUE(ascent.is_complete());
  return ascent;
}

double time_lost(const Ascent& ascent, double top) {
  double time = 0.0;
  for (const Phase& phase : ascent.phases()) {
    time += phase.duration;
  }
  return time - ascent.reached() / top;
}

std::vector<LimitZone> random_staircase(std::mt19937& random, int count, double lowest,
                                        double longest) {
  std::vector<LimitZone> zones;
  double s = 0.0;
  double limit = lowest;
  for (int i = 0; i < count; ++i) {
    const double end = s + log_uniform(random, 0.01, longest);
    zones.push_back({s, end, limit});
    s = end;
    limit *= log_uniform(random, 1.02, 2.0);
  }
  return zones;
}

TEST(Ascent, UnderOneLimitIsTheRamp) {
  const Ascent ascent = whole({{0.0, 100.0, 50.0}}, kTable2);
  EXPECT_NEAR(ascent.reached(), 25.0 * 2.0 * std::sqrt(50.0 / 50000.0), 1e-12);
  const Ascent fast = whole({{0.0, 100.0, 200.0}}, kTable2);  // with a phase of constant A
  EXPECT_NEAR(fast.reached(), 100.0 * (200.0 / 2450.0 + 2450.0 / 50000.0), 1e-10);
}

TEST(Ascent, LeavesARestThatIsBeforeTheFirstZoneByRounding) {
  Ascent ascent;
  const std::vector<LimitZone> zones{{4e-10, 100.0, 50.0}};
  ascent.start(zones, 0, {0.0, 0.0}, Sense::kForward, kTable2, 50.0);
  ascent.extend();
  ASSERT_FALSE(ascent.phases().empty());
  EXPECT_EQ(ascent.phases().front().j, kTable2.jerk);  // not a hold at rest, which has no end
  EXPECT_GT(ascent.top(), 0.0);
}

TEST(Ascent, PassesTheEdgeOfAStepWithAccelerationOnTheParabolaOfMinusJ) {
  // The edge lies where the ramp to 50 mm/s has 12 mm/s: -J begins before it and just meets it.
  const double t = std::sqrt(2.0 * 12.0 / 50000.0);
  const double edge = 50000.0 * t * t * t / 6.0;
  const Ascent ascent = whole({{0.0, edge, 10.0}, {edge, 100.0, 50.0}}, kTable2);
  double v = -1.0;
  double a = -1.0;
  for (const Phase& phase : ascent.phases()) {
    if (std::abs(phase.s - edge) < 1e-9) {
      v = phase.v;
      a = phase.a;
    }
  }
  EXPECT_NEAR(v, 10.0, 1e-7);
  EXPECT_GT(a, 100.0);
  // Back from there +J, forward from rest +J: both meet where the phases say.
  const Phase& second = ascent.phases()[1];
  EXPECT_LT(second.j, 0.0);
  EXPECT_NEAR(second.v, 0.5 * second.a * second.a / 50000.0, 1e-9);
  EXPECT_NEAR(second.v + 0.5 * (second.a * second.a - a * a) / 50000.0, 10.0, 1e-7);
}

TEST(Ascent, WaitsAtTheLimitWhereTheStepIsLong) {
  const Ascent ascent = whole({{0.0, 30.0, 20.0}, {30.0, 100.0, 50.0}}, kTable2);
  const double first = 10.0 * 2.0 * std::sqrt(20.0 / 50000.0);
  const double second = 35.0 * 2.0 * std::sqrt(30.0 / 50000.0);
  EXPECT_NEAR(ascent.reached(), 30.0 + second, 1e-9);
  EXPECT_NEAR(ascent.exit_at(20.0).distance, first, 1e-9);
}

TEST(Ascent, RandomStaircasesAreKeptAndPNeverFalls) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const RampLimits ramp = test::random_limits(random);
    const auto zones = random_staircase(random, 1 + static_cast<int>(random() % 60),
                                        log_uniform(random, 0.1, 20.0), 3.0);
    const Ascent ascent = whole(zones, ramp);
    const test::MotionProfile profile(ascent.phases());
    ASSERT_NO_FATAL_FAILURE(test::expect_feasible(profile, ramp)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(test::expect_under_zones(profile, zones)) << "case " << i;
    double p = 0.0;
    for (const Phase& phase : ascent.phases()) {
      const double now = phase.v + 0.5 * phase.a * phase.a / ramp.jerk;
      ASSERT_GE(now, p * (1.0 - 1e-9)) << "case " << i;
      p = now;
    }
  }
}

TEST(Ascent, IsLeftAtEveryFeedrateUnderEveryStep) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    const auto zones = random_staircase(random, 12, log_uniform(random, 0.5, 20.0), 1.0);
    const Ascent ascent = whole(zones, kTable2);
    double last = 0.0;
    for (int k = 1; k <= 20; ++k) {
      const double v = zones.back().limit * k / 20.0;
      const Ascent::Exit exit = ascent.exit_at(v);
      ASSERT_NEAR(exit.at.v + 0.5 * exit.at.a * exit.at.a / kTable2.jerk, v, 1e-7 * v);
      ASSERT_GE(exit.distance, last - 1e-9);
      last = exit.distance;
      const Phase leave{exit.at.a / kTable2.jerk, exit.at.s, exit.at.v, exit.at.a, -kTable2.jerk};
      for (const LimitZone& zone : zones) {
        if (zone.end > leave.s && zone.end < exit.distance) {
          ASSERT_LE(motion_at(leave, time_at(leave, zone.end - 1e-9)).v, zone.limit + 1e-6);
        }
      }
    }
  }
}

TEST(Ascent, LosesLittleMoreTimeThanTheBestOfAllOnALattice) {
  std::mt19937 random(3);
  const RampLimits ramp{2450.0, 50000.0};
  constexpr double kStep = 1e-3;
  double lost = 0.0;
  double best = 0.0;
  for (int i = 0; i < 12; ++i) {
    auto zones = random_staircase(random, 4, 4.0, 0.4);
    const double unit = ramp.jerk * kStep * kStep;
    for (LimitZone& zone : zones) {
      zone.limit = unit * std::round(zone.limit / unit);
    }
    const double here = time_lost(whole(zones, ramp), zones.back().limit);
    const double there = test::least_time_lost(zones, ramp, kStep);
    EXPECT_LE(here, 1.1 * there + kStep) << "case " << i;
    lost += here;
    best += there;
  }
  RecordProperty("lost_us", static_cast<int>(1e6 * lost));
  RecordProperty("best_us", static_cast<int>(1e6 * best));
  EXPECT_LE(lost, 1.05 * best);
}

}  // namespace ascent_test
}  // namespace twin::feedrate

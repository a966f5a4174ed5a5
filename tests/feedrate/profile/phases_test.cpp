#include "feedrate/profile/phases.hpp"

#include <gtest/gtest.h>

#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace phases_test {

using test::log_uniform;

TEST(Phase, HasTheDerivativesOfItsDistance) {
  const Phase phase{0.3, 2.0, 10.0, -40.0, 500.0};
  constexpr double kH = 1e-4;
  for (double t = kH; t < 0.3; t += 0.05) {
    const PathMotion before = motion_at(phase, t - kH);
    const PathMotion at = motion_at(phase, t);
    const PathMotion after = motion_at(phase, t + kH);
    EXPECT_NEAR(at.v, (after.s - before.s) / (2.0 * kH), 1e-5);
    EXPECT_NEAR(at.a, (after.v - before.v) / (2.0 * kH), 1e-7);
    EXPECT_NEAR(phase.j, (after.a - before.a) / (2.0 * kH), 1e-7);
  }
}

TEST(Phase, TimeAtInvertsItsDistance) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double duration = log_uniform(random, 1e-4, 0.5);
    // Feedrates stay positive: from v1 with a and j that lose no more than v1 altogether.
    const double v = log_uniform(random, 0.1, 200.0);
    const double a = v / duration * (part(random) - 0.4);
    const double j = v / duration / duration * (part(random) - 0.3);
    const Phase phase{duration, 3.0 * part(random), v, a, j};
    const double t = duration * part(random);
    EXPECT_NEAR(time_at(phase, motion_at(phase, t).s), t, 1e-9 * duration);
  }
}

TEST(Phase, TimeAtIsRightFromAndToRest) {
  const Phase start{0.02, 5.0, 0.0, 0.0, 50000.0};
  EXPECT_NEAR(time_at(start, 5.0), 0.0, 1e-6);
  EXPECT_NEAR(time_at(start, motion_at(start, 1e-3).s), 1e-3, 1e-9);
  const Phase stop{0.02, 0.0, 10.0, -1000.0, 50000.0};
  const PathMotion end = motion_at(stop, 0.02);
  ASSERT_NEAR(end.v, 0.0, 1e-12);
  EXPECT_NEAR(time_at(stop, motion_at(stop, 0.019).s), 0.019, 1e-9);
  EXPECT_NEAR(motion_at(stop, time_at(stop, end.s)).s, end.s, 1e-12);
}

TEST(Phase, TimeAtBeyondItsEndsIsAtThem) {
  const Phase phase{0.1, 1.0, 20.0, 10.0, -30.0};
  EXPECT_NEAR(time_at(phase, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(time_at(phase, 99.0), 0.1, 1e-15);
}

TEST(Phase, RemainderGoesOnWhereThePhaseWas) {
  const Phase phase{0.1, 1.0, 20.0, 10.0, -300.0};
  const Phase rest = remainder_after(phase, 0.03);
  EXPECT_NEAR(rest.duration, 0.07, 1e-15);
  for (double t = 0.0; t < 0.07; t += 0.01) {
    EXPECT_NEAR(motion_at(rest, t).s, motion_at(phase, 0.03 + t).s, 1e-13);
    EXPECT_NEAR(motion_at(rest, t).v, motion_at(phase, 0.03 + t).v, 1e-12);
  }
}

TEST(Phases, OfAHumpWithRoomAreSeven) {
  const RampLimits limits{2450.0, 50000.0};
  std::vector<Phase> phases;
  append_phases(make_hump({0, 0}, {100, 0}, 180.0, limits), limits, phases);
  ASSERT_EQ(phases.size(), 7U);
  const double signs[] = {1, 0, -1, 0, -1, 0, 1};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(phases[i].j, 50000.0 * signs[i], 1e-3);
  }
}

/// Joins, ends and limits of the phases of one hump.
void expect_whole(const Hump& hump, const RampLimits& limits, double slack) {
  std::vector<Phase> phases;
  append_phases(hump, limits, phases);
  ASSERT_FALSE(phases.empty());
  PathMotion at{hump.a.s, hump.a.v, 0.0};
  const double v_scale = hump.peak;
  for (const Phase& phase : phases) {
    ASSERT_GE(phase.duration, 0.0);
    ASSERT_NEAR(phase.s, at.s, 1e-9);
    ASSERT_NEAR(phase.v, at.v, 1e-9 * v_scale);
    ASSERT_NEAR(phase.a, at.a, 1e-8 * limits.acceleration);
    ASSERT_LE(std::abs(phase.j), limits.jerk * (1.0 + slack));
    at = motion_at(phase, phase.duration);
    ASSERT_LE(std::abs(at.a), limits.acceleration * (1.0 + slack));
    ASSERT_LE(at.v, hump.peak * (1.0 + 1e-9));
    ASSERT_GE(at.v, -1e-9 * v_scale);
  }
  ASSERT_NEAR(at.s, hump.b.s, 1e-9);
  ASSERT_NEAR(at.v, hump.b.v, 1e-9 * v_scale);
  ASSERT_NEAR(at.a, 0.0, 1e-8 * limits.acceleration);
}

TEST(Phases, OfRandomHumpsJoinAndKeepTheLimits) {
  std::mt19937 random(2);
  for (int i = 0; i < 20000; ++i) {
    const RampLimits limits = test::random_limits(random);
    const double d = log_uniform(random, 1e-3, 300.0);
    const double v1 = random() % 4 == 0 ? 0.0 : log_uniform(random, 0.01, 300.0);
    const double most = ramp_reach(v1, d, limits);
    const double v2 = v1 + (most - v1) * std::uniform_real_distribution<double>()(random);
    const Anchor low{1.0, v1};
    const Anchor high{1.0 + d, v2};
    const double cap = v2 * log_uniform(random, 1.0, 5.0) + 0.01;
    ASSERT_NO_FATAL_FAILURE(expect_whole(make_hump(low, high, cap, limits), limits, 1e-6));
    const Anchor fast{1.0, v2};
    const Anchor slow{1.0 + d, v1};
    ASSERT_NO_FATAL_FAILURE(expect_whole(make_hump(fast, slow, cap, limits), limits, 1e-6));
  }
}

}  // namespace phases_test
}  // namespace twin::feedrate

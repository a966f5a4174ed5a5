#include "feedrate/paper/envelope.hpp"

#include <gtest/gtest.h>

#include "tests/support/motion_profile.hpp"
#include "tests/support/random_zones.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace envelope_test {

using test::expect_feasible;
using test::expect_under_zones;
using test::log_uniform;
using test::MotionProfile;
using test::random_zones;

constexpr RampLimits kTable2{2450.0, 50000.0};

MotionProfile profile_of(const Envelope& envelope, const RampLimits& limits) {
  std::vector<Phase> phases;
  for (const Hump& hump : envelope.humps()) {
    append_phases(hump, limits, phases);
  }
  return MotionProfile(phases);
}

/// Time with a stop at every border of zones [s].
double stopping_time(const std::vector<LimitZone>& zones, const RampLimits& limits) {
  double time = 0.0;
  for (const LimitZone& zone : zones) {
    std::vector<Phase> phases;
    append_phases(make_hump({zone.begin, 0.0}, {zone.end, 0.0}, zone.limit, limits), limits,
                  phases);
    time += MotionProfile(phases).duration();
  }
  return time;
}

TEST(Envelope, FromRestToRestIsAlwaysFoundAndKeepsEveryLimit) {
  std::mt19937 random(1);
  for (int i = 0; i < 30000; ++i) {
    const auto zones = random_zones(random);
    RampLimits limits = test::random_limits(random);
    limits.profile = test::kProfiles[static_cast<std::size_t>(i) % 3];
    Envelope envelope(limits);
    const Anchor start{zones.front().begin, 0.0};
    const Anchor end{zones.back().end, 0.0};
    ASSERT_TRUE(envelope.plan(zones, start, end)) << "case " << i;
    const auto& humps = envelope.humps();
    ASSERT_EQ(humps.front().a.s, start.s);
    ASSERT_EQ(humps.front().a.v, 0.0);
    ASSERT_EQ(humps.back().b.s, end.s);
    ASSERT_EQ(humps.back().b.v, 0.0);
    for (std::size_t k = 1; k < humps.size(); ++k) {
      ASSERT_EQ(humps[k].a.s, humps[k - 1].b.s);
      ASSERT_EQ(humps[k].a.v, humps[k - 1].b.v);
    }
    const MotionProfile profile = profile_of(envelope, limits);
    ASSERT_NO_FATAL_FAILURE(expect_feasible(profile, limits)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_under_zones(profile, zones)) << "case " << i;
  }
}

TEST(Envelope, IsNeverSlowerThanStoppingAtEveryBorder) {
  std::mt19937 random(2);
  for (int i = 0; i < 30000; ++i) {
    const auto zones = random_zones(random);
    RampLimits limits = kTable2;
    limits.profile = test::kProfiles[static_cast<std::size_t>(i) % 3];
    Envelope envelope(limits);
    ASSERT_TRUE(envelope.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}));
    const double time = profile_of(envelope, limits).duration();
    EXPECT_LE(time, stopping_time(zones, limits) * (1.0 + 1e-6)) << "case " << i;
  }
}

TEST(Envelope, IsNeverFasterThanAccelerationAloneAllows) {
  std::mt19937 random(3);
  double closest = 1e9;
  for (int i = 0; i < 2000; ++i) {
    const auto zones = random_zones(random);
    const RampLimits limits = test::random_limits(random);
    Envelope envelope(limits);
    ASSERT_TRUE(envelope.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}));
    const double bound = test::acceleration_bound(zones, 0.0, 0.0, limits.acceleration, 1000);
    const double time = profile_of(envelope, limits).duration();
    ASSERT_GE(time, bound * (1.0 - 1e-6)) << "case " << i;
    closest = std::min(closest, time / bound);
  }
  EXPECT_LT(closest, 1.1);
}

TEST(Envelope, ComesCloseToTheAccelerationBoundWhenJerkIsPlenty) {
  // Along a staircase a = 0 at every step costs time, so one low zone between two high ones.
  const std::vector<LimitZone> zones{{0, 20, 150}, {20, 21, 20}, {21, 40, 150}};
  const RampLimits limits{2450.0, 1e8};
  Envelope envelope(limits);
  ASSERT_TRUE(envelope.plan(zones, {0, 0}, {40, 0}));
  const double bound = test::acceleration_bound(zones, 0.0, 0.0, 2450.0, 100000);
  EXPECT_NEAR(profile_of(envelope, limits).duration(), bound, 0.004 * bound);
}

TEST(Envelope, UnderOneLimitIsOneHump) {
  Envelope envelope(kTable2);
  std::vector<LimitZone> zones;
  for (int i = 0; i < 50; ++i) {
    zones.push_back({1.0 * i, 1.0 * (i + 1), 50.0});
  }
  ASSERT_TRUE(envelope.plan(zones, {0, 0}, {50, 0}));
  ASSERT_EQ(envelope.humps().size(), 1U);
  EXPECT_EQ(envelope.humps()[0].peak, 50.0);
}

TEST(Envelope, TouchesALowPlaceWithItsLimit) {
  Envelope envelope(kTable2);
  const std::vector<LimitZone> zones{{0, 10, 50}, {10, 10, 7}, {10, 20, 50}};
  ASSERT_TRUE(envelope.plan(zones, {0, 0}, {20, 0}));
  const MotionProfile profile = profile_of(envelope, kTable2);
  EXPECT_NEAR(profile.feedrate_at(10.0), 7.0, 1e-3);
  ASSERT_EQ(envelope.humps().size(), 2U);
  EXPECT_TRUE(envelope.humps()[0].b.is_at_limit);
}

TEST(Envelope, StopsAtAPlaceWithLimitNothing) {
  Envelope envelope(kTable2);
  const std::vector<LimitZone> zones{{0, 10, 50}, {10, 10, 0}, {10, 10, 0}, {10, 20, 50}};
  ASSERT_TRUE(envelope.plan(zones, {0, 0}, {20, 0}));
  double slowest = 50.0;
  for (const Hump& hump : envelope.humps()) {
    slowest = std::abs(hump.b.s - 10.0) < 1e-9 ? std::min(slowest, hump.b.v) : slowest;
  }
  EXPECT_EQ(slowest, 0.0);
}

TEST(Envelope, KnotThatTheRampPassesUnderWayOnlyDoesNotFail) {
  // From 18.698 mm/s to rest a ramp fits, but none that passes 4.994 mm without acceleration.
  const std::vector<LimitZone> zones{
      {3.7235, 4.79995, 18.6975}, {4.79995, 4.99393, 66.77}, {4.99393, 5.30107, 18.7915}};
  Envelope envelope(kTable2);
  ASSERT_TRUE(envelope.plan(zones, {3.7235, 0}, {5.30107, 0}));
  expect_under_zones(profile_of(envelope, kTable2), zones);
}

TEST(Envelope, RefusesAStartThatIsTooFast) {
  Envelope envelope(kTable2);
  const std::vector<LimitZone> open{{0, 1, 100}};
  EXPECT_FALSE(envelope.plan(open, {0, 80}, {1, 0}));
  const std::vector<LimitZone> low{{0, 10, 100}, {10, 20, 1}, {20, 30, 100}};
  EXPECT_FALSE(envelope.plan(low, {9, 80}, {30, 0}));
  EXPECT_TRUE(envelope.plan(low, {0, 80}, {30, 0}));
}

TEST(Envelope, PlannedAgainFromOneOfItsKnotsIsTheSame) {
  std::mt19937 random(4);
  std::size_t again = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto zones = random_zones(random);
    Envelope envelope(kTable2);
    const Anchor end{zones.back().end, 0.0};
    ASSERT_TRUE(envelope.plan(zones, {zones.front().begin, 0.0}, end));
    const std::vector<Hump> whole = envelope.humps();
    const Anchor anchor = whole[random() % whole.size()].a;
    const auto from = std::find_if(zones.begin(), zones.end(), [&](const LimitZone& zone) {
      return zone.end > anchor.s + 1e-9;
    });
    if (anchor.v == 0.0 || from == zones.end()) {
      continue;
    }
    ++again;
    ASSERT_TRUE(envelope.plan({from, zones.end()}, anchor, end)) << "case " << i;
    double rest = 0.0;
    for (const Hump& hump : whole) {
      std::vector<Phase> phases;
      append_phases(hump, kTable2, phases);
      rest += hump.a.s >= anchor.s ? MotionProfile(phases).duration() : 0.0;
    }
    ASSERT_LE(profile_of(envelope, kTable2).duration(), rest * (1.0 + 1e-6)) << "case " << i;
  }
  EXPECT_GT(again, 500U);
}

}  // namespace envelope_test
}  // namespace twin::feedrate

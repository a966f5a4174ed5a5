#include "feedrate/certified/passage_glide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

// Plans over passages, zones that are held: what each phase does is looked at place by place.
namespace twin::feedrate {
namespace passage_glide_test {

constexpr RampLimits kRamp{2450.0, 50000.0};

double any(std::mt19937& random, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<>(0.0, 1.0)(random);
}

LimitZone passage(double begin, double end, double v) {
  return {begin, end, v, 400.0, 400.0, 15000.0, 0.6 * v};
}

/// Lines of 50 mm/s with passages between them.
std::vector<LimitZone> any_zones(std::mt19937& random, double longest) {
  std::vector<LimitZone> zones;
  double s = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double line = any(random, 0.05, longest);
    zones.push_back({s, s + line, 50.0});
    s += line;
    const double v = any(random, 5.0, 50.0);
    zones.push_back(passage(s, s + 0.1 * v, v));
    s = zones.back().end;
  }
  zones.push_back({s, s + 1.0, 50.0});
  return zones;
}

/// Fails unless the phases join, keep limits, and keep one feedrate in passages that are fast.
void expect_kept(const PassageGlide& glide, const std::vector<LimitZone>& zones,
                 const Anchor& start, double end) {
  PathMotion at{start.s, start.v, 0.0};
  for (const Phase& phase : glide.phases()) {
    ASSERT_NEAR(phase.s, at.s, 1e-8);
    ASSERT_NEAR(phase.v, at.v, 1e-5);
    ASSERT_NEAR(phase.a, at.a, 1e-2);
    for (int k = 0; k <= 20; ++k) {
      const PathMotion m = motion_at(phase, phase.duration * k / 20.0);
      const auto zone = std::find_if(zones.begin(), zones.end(), [&](const LimitZone& z) {
        return m.s > z.begin + 1e-7 && m.s < z.end - 1e-7;
      });
      if (zone == zones.end()) {
        continue;
      }
      ASSERT_LE(m.v, zone->limit * (1.0 + 1e-6)) << m.s;
      const bool is_held = m.v > zone->held_above * (1.0 + 1e-6);
      ASSERT_LE(std::abs(m.a), is_held ? 1e-3 : std::min(zone->acceleration, 2450.0) * 1.001)
          << m.s << " at " << m.v;
      ASSERT_LE(std::abs(phase.j), is_held ? 1e-3 : std::min(zone->jerk, 50000.0) * 1.001) << m.s;
    }
    at = motion_at(phase, phase.duration);
  }
  ASSERT_NEAR(at.s, end, 1e-8);
  ASSERT_NEAR(at.v, 0.0, 1e-4);
}

TEST(PassageGlide, FromRestThereIsAlwaysAPlanThatHoldsPassages) {
  std::mt19937 random(1);
  int even = 0;
  for (int i = 0; i < 300; ++i) {
    const auto zones = any_zones(random, i % 2 == 0 ? 0.6 : 6.0);
    // From the begin, from some place on a line or in a passage, to the end or to some place.
    const double last = zones.back().end;
    const double from = i % 3 == 0 ? 0.0 : any(random, 0.0, 0.5 * last);
    const double to = i % 4 == 0 ? last : any(random, from + 0.1 * (last - from), last);
    std::vector<LimitZone> covered;
    std::copy_if(zones.begin(), zones.end(), std::back_inserter(covered),
                 [&](const LimitZone& z) { return z.end > from + 1e-9 && z.begin < to - 1e-9; });
    PassageGlide glide;
    ASSERT_TRUE(glide.plan(covered, {from, 0.0}, {to, 0.0}, kRamp)) << i;
    even += glide.is_even() ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(expect_kept(glide, covered, {from, 0.0}, to)) << i;
  }
  EXPECT_LE(even, 30);  // lines here are shorter than a path would have them
}

TEST(PassageGlide, APassageWithRoomIsHeldAtItsLimit) {
  const std::vector<LimitZone> zones{
      {0.0, 10.0, 50.0}, passage(10.0, 14.0, 40.0), {14.0, 24.0, 50.0}};
  PassageGlide glide;
  ASSERT_TRUE(glide.plan(zones, {0.0, 0.0}, {24.0, 0.0}, kRamp));
  const auto hold = std::find_if(glide.phases().begin(), glide.phases().end(),
                                 [](const Phase& phase) { return phase.s == 10.0; });
  ASSERT_NE(hold, glide.phases().end());
  EXPECT_EQ(hold->v, 40.0);
  EXPECT_NEAR(hold->duration, 0.1, 1e-12);
  EXPECT_EQ(glide.free_end(), 24.0);
}

// A start in a passage goes on with its feedrate to the end.
TEST(PassageGlide, AStartWithinAPassageHoldsItsFeedrate) {
  const std::vector<LimitZone> zones{passage(0.0, 4.0, 40.0), {4.0, 24.0, 50.0}};
  PassageGlide glide;
  ASSERT_TRUE(glide.plan(zones, {1.0, 30.0}, {24.0, 0.0}, kRamp));
  EXPECT_EQ(glide.phases()[0].v, 30.0);
  EXPECT_NEAR(glide.phases()[0].duration, 0.1, 1e-12);
  ASSERT_NO_FATAL_FAILURE(expect_kept(glide, zones, {1.0, 30.0}, 24.0));
}

// The end of the plan slows down the passages before it; what is before them is final.
TEST(PassageGlide, TellsFromWhereOnTheEndOfThePlanMatters) {
  std::vector<LimitZone> zones;
  double s = 0.0;
  for (int i = 0; i < 12; ++i) {
    zones.push_back({s, s + 1.5, 50.0});
    zones.push_back(passage(s + 1.5, s + 4.5, 30.0));
    s += 4.5;
  }
  PassageGlide near, far;
  ASSERT_TRUE(near.plan(std::vector<LimitZone>(zones.begin(), zones.begin() + 17), {0.0, 0.0},
                        {zones[16].begin + 0.3, 0.0}, kRamp));
  ASSERT_TRUE(far.plan(zones, {0.0, 0.0}, {s, 0.0}, kRamp));
  EXPECT_LT(near.free_end(), zones[16].begin);
  EXPECT_GT(near.free_end(), 3.0);
  const auto final = near.first_after_passage();
  ASSERT_GT(final, 3U);
  for (std::size_t i = 0; i < final; ++i) {
    EXPECT_NEAR(near.phases()[i].duration, far.phases()[i].duration, 1e-12) << i;
    EXPECT_NEAR(near.phases()[i].v, far.phases()[i].v, 1e-9) << i;
  }
}

}  // namespace passage_glide_test
}  // namespace twin::feedrate

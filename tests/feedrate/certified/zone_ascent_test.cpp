#include "feedrate/certified/zone_ascent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "feedrate/certified/glide.hpp"
#include "tests/support/random_zones.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace zone_ascent_test {

using test::log_uniform;

constexpr RampLimits kTable2{2450.0, 50000.0};

/// Zones with limits that rise, and with ramps of their own from a twentieth of the machine's on.
std::vector<LimitZone> random_staircase(std::mt19937& random, int count, double least_share) {
  std::vector<LimitZone> zones;
  double s = 0.0;
  double limit = log_uniform(random, 0.1, 20.0);
  for (int i = 0; i < count; ++i) {
    const double end = s + log_uniform(random, 0.01, 3.0);
    zones.push_back({s, end, limit});
    const auto share = [&] { return log_uniform(random, least_share, 1.0); };
    zones.back().acceleration = share() * kTable2.acceleration;
    zones.back().deceleration = share() * kTable2.acceleration;
    zones.back().jerk = share() * kTable2.jerk;
    s = end;
    limit *= log_uniform(random, 1.0, 1.5);
  }
  return zones;
}

/// Lets zones allow more acceleration below their limits.
void allow_more_below(std::mt19937& random, std::vector<LimitZone>& zones) {
  for (LimitZone& zone : zones) {
    if (zone.end > zone.begin) {
      zone.most = log_uniform(random, 0.1, 1.0) * kTable2.acceleration;
      zone.bend = log_uniform(random, 0.01, 1.0) / std::pow(zone.limit, 2);
      zone.power = zone.limit * log_uniform(random, 0.1, 10.0) * zone.acceleration;
      zone.fade_up = log_uniform(random, 0.01, 1.0) / std::pow(zone.limit, 3);
      zone.fade_down = log_uniform(random, 0.01, 1.0) / std::pow(zone.limit, 3);
    }
  }
}

/// Acceleration that a zone allows at a feedrate, by the formula of ramp_levels.hpp.
double allowed(const LimitZone& zone, double at_limit, double fade, double v) {
  const double below = v > 0.0 && v < zone.limit
                           ? zone.power * (1.0 - fade * v * v * v) / v
                           : (v > 0.0 ? 0.0 : std::numeric_limits<double>::infinity());
  return std::max(at_limit, std::min(zone.most * (1.0 - zone.bend * v * v), below));
}

/// How often a rise may be extended: it is complete before.
constexpr int kExtensions = 4000;

template <class Ascent>
Ascent whole(const std::vector<LimitZone>& zones) {
  Ascent ascent;
  ascent.start(zones, 0, {0.0, 0.0}, Sense::kForward, kTable2, zones.back().limit);
  for (int i = 0; i < kExtensions && !ascent.is_complete(); ++i) {
    ascent.extend();
  }
  EXPECT_TRUE(ascent.is_complete());
  return ascent;
}

/// Fails unless phases join and keep the acceleration and jerk of every zone that they pass.
void expect_within_zones(const std::vector<Phase>& phases, const std::vector<LimitZone>& zones) {
  constexpr double kPlace = 2e-9;
  PathMotion at{phases.front().s, phases.front().v, phases.front().a};
  for (const Phase& phase : phases) {
    ASSERT_NEAR(phase.s, at.s, kPlace);
    ASSERT_NEAR(phase.v, at.v, 1e-6);
    ASSERT_NEAR(phase.a, at.a, 1e-3);
    at = motion_at(phase, phase.duration);
    if (at.s - phase.s < 1e-6) {
      continue;  // a ramp that is 1 nm longer than its room is that much steeper
    }
    for (const LimitZone& zone : zones) {
      if (zone.end - kPlace <= phase.s || zone.begin + kPlace >= at.s) {
        continue;
      }
      ASSERT_LE(std::abs(phase.j), zone.jerk * (1.0 + 1e-6)) << phase.s;
      for (const double s : {std::max(zone.begin, phase.s), std::min(zone.end, at.s)}) {
        const auto [place, v, a] = motion_at(phase, time_at(phase, s));
        ASSERT_LE(a, allowed(zone, zone.acceleration, zone.fade_up, v) * (1.0 + 1e-6) + 1e-3) << s;
        ASSERT_LE(-a, allowed(zone, zone.deceleration, zone.fade_down, v) * (1.0 + 1e-6) + 1e-3)
            << s;
      }
    }
  }
}

TEST(ZoneAscent, UnderOneRampIsTheAscent) {
  std::mt19937 random(1);
  for (int i = 0; i < 300; ++i) {
    const auto zones = random_staircase(random, 1 + static_cast<int>(random() % 20), 1.0);
    const auto ascent = whole<Ascent>(zones);
    const auto zone_ascent = whole<ZoneAscent>(zones);
    const double v = zones.back().limit;
    ASSERT_NEAR(zone_ascent.exit_at(v).distance, ascent.exit_at(v).distance,
                1e-6 * (1.0 + ascent.exit_at(v).distance));
    ASSERT_NEAR(zone_ascent.exit_at(0.5 * v).distance, ascent.exit_at(0.5 * v).distance, 1e-6);
  }
}

TEST(ZoneAscent, RandomStaircasesAreKeptAndLeftAtEveryFeedrate) {
  std::mt19937 random(2);
  for (int i = 0; i < 500; ++i) {
    const auto zones = random_staircase(random, 1 + static_cast<int>(random() % 25), 0.02);
    const auto ascent = whole<ZoneAscent>(zones);
    ASSERT_NO_FATAL_FAILURE(expect_within_zones(ascent.phases(), zones)) << "case " << i;
    test::expect_under_zones(test::MotionProfile(ascent.phases()), zones);
    double last = 0.0;
    for (int k = 1; k <= 10; ++k) {
      const double v = zones.back().limit * k / 10.0;
      const Rise::Exit exit = ascent.exit_at(v);
      ASSERT_GE(exit.distance, last - 1e-7) << "case " << i;
      last = exit.distance;
      std::vector<Phase> out;
      ascent.append_way_out(exit, out);
      if (!out.empty()) {
        ASSERT_NO_FATAL_FAILURE(expect_within_zones(out, zones)) << "case " << i;
        const PathMotion end = motion_at(out.back(), out.back().duration);
        ASSERT_NEAR(end.v, v, 1e-7 * v);
        ASSERT_NEAR(end.a, 0.0, 1e-6);
      }
    }
  }
}

TEST(ZoneAscent, WhereMoreIsAllowedBelowTheLimitItIsUsedAndKept) {
  std::mt19937 random(5);
  double with = 0.0;
  double without = 0.0;
  for (int i = 0; i < 300; ++i) {
    auto zones = random_staircase(random, 1 + static_cast<int>(random() % 25), 0.02);
    const auto time_of = [](const std::vector<Phase>& phases) {
      return test::MotionProfile(phases).duration();
    };
    without += time_of(whole<ZoneAscent>(zones).phases());
    allow_more_below(random, zones);
    const auto ascent = whole<ZoneAscent>(zones);
    ASSERT_NO_FATAL_FAILURE(expect_within_zones(ascent.phases(), zones)) << "case " << i;
    test::expect_under_zones(test::MotionProfile(ascent.phases()), zones);
    with += time_of(ascent.phases());
  }
  EXPECT_LT(with, 0.98 * without);
}

// Each zone is cut and extended a few times: the work is bounded by their number.
TEST(ZoneAscent, IsExtendedAFewTimesForEachZone) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto zones = random_staircase(random, 40, 1e-4);
    ZoneAscent ascent;
    ascent.start(zones, 0, {0.0, 0.0}, Sense::kForward, kTable2, zones.back().limit);
    int count = 0;
    for (; count < 6 * 41 && !ascent.is_complete(); ++count) {
      ascent.extend();
    }
    ASSERT_TRUE(ascent.is_complete()) << "case " << i;
  }
}

// With a jerk of 6e7 mm/s^3 a place that is known to 1e-13 mm leaves the acceleration in doubt by more than a
// thousand millionth. A rise then lost all of its acceleration, and held its feedrate to the end of the zone.
TEST(ZoneAscent, ARiseIsNotHeldBelowTheLimitWhereRoundingPutsItAboveALevel) {
  std::mt19937 random(8);
  for (int i = 0; i < 300; ++i) {
    auto zones = random_staircase(random, 1 + static_cast<int>(random() % 25), 0.02);
    allow_more_below(random, zones);
    for (LimitZone& zone : zones) {
      zone.jerk *= 1000.0;
    }
    ZoneAscent ascent;
    ascent.start(zones, 0, {0.0, 0.0}, Sense::kForward,
                 {kTable2.acceleration, 1000.0 * kTable2.jerk}, zones.back().limit);
    for (int k = 0; k < kExtensions && !ascent.is_complete(); ++k) {
      ascent.extend();
    }
    ASSERT_TRUE(ascent.is_complete()) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_within_zones(ascent.phases(), zones)) << "case " << i;
    for (const Phase& phase : ascent.phases()) {
      const auto zone = std::find_if(zones.begin(), zones.end(), [&](const LimitZone& candidate) {
        return candidate.end > phase.s + 1e-9;
      });
      if (phase.a == 0.0 && phase.j == 0.0 && zone != zones.end() &&
          phase.v * phase.duration > 1e-6) {
        EXPECT_GE(phase.v, zone->limit * (1.0 - 1e-6)) << "case " << i << " at " << phase.s;
      }
    }
  }
}

TEST(ZoneAscent, AGlideOfRandomZonesKeepsTheRampsOfEach) {
  std::mt19937 random(4);
  int even = 0;
  for (int i = 0; i < 400; ++i) {
    auto zones = test::random_zones(random);
    for (LimitZone& zone : zones) {
      if (zone.end > zone.begin) {
        zone.acceleration = log_uniform(random, 0.02, 1.0) * kTable2.acceleration;
        zone.deceleration = log_uniform(random, 0.02, 1.0) * kTable2.acceleration;
        zone.jerk = log_uniform(random, 0.02, 1.0) * kTable2.jerk;
      }
    }
    if (i % 2 == 0) {
      allow_more_below(random, zones);
    }
    Glide glide;
    ASSERT_TRUE(glide.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}, kTable2))
        << "case " << i;
    even += glide.is_even() ? 1 : 0;
    ASSERT_NO_FATAL_FAILURE(expect_within_zones(glide.phases(), zones)) << "case " << i;
    test::expect_under_zones(test::MotionProfile(glide.phases()), zones);
    const PathMotion end = motion_at(glide.phases().back(), glide.phases().back().duration);
    ASSERT_NEAR(end.s, zones.back().end, 1e-8) << "case " << i;
    ASSERT_NEAR(end.v, 0.0, 1e-6) << "case " << i;
  }
  EXPECT_LE(even, 4);
}

}  // namespace zone_ascent_test
}  // namespace twin::feedrate

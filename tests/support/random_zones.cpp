#include "random_zones.hpp"

#include <gtest/gtest.h>

#include "tests/support/s_curve.hpp"

namespace twin::test {

std::vector<feedrate::LimitZone> random_zones(std::mt19937& random) {
  const auto count = 1 + random() % 30;
  const double shortest = random() % 2 == 0 ? 1e-3 : 1e-5;
  const double longest = log_uniform(random, 0.01, 30.0);
  std::vector<feedrate::LimitZone> zones;
  double s = log_uniform(random, 1e-3, 10.0);
  for (std::size_t i = 0; i < count; ++i) {
    const double end = s + log_uniform(random, shortest, longest);
    zones.push_back({s, end, log_uniform(random, 0.2, 200.0)});
    s = end;
    if (i + 1 < count && random() % 4 == 0) {
      zones.push_back({s, s, random() % 6 == 0 ? 0.0 : log_uniform(random, 0.1, 100.0)});
    }
  }
  return zones;
}

void expect_under_zones(const MotionProfile& profile,
                        const std::vector<feedrate::LimitZone>& zones) {
  constexpr double kPlace = 2e-9;
  for (const feedrate::LimitZone& zone : zones) {
    const double most = zone.limit * (1.0 + 1e-6) + 1e-6;
    if (zone.begin == zone.end) {
      ASSERT_LE(std::min({profile.feedrate_at(zone.begin - kPlace), profile.feedrate_at(zone.begin),
                          profile.feedrate_at(zone.end + kPlace)}),
                most);
      continue;
    }
    for (int i = 0; i <= 12; ++i) {
      const double s = zone.begin + kPlace + (zone.end - zone.begin - 2.0 * kPlace) * i / 12.0;
      ASSERT_LE(profile.feedrate_at(s), most) << "in " << zone.begin << " to " << zone.end;
    }
  }
}

void expect_feasible(const MotionProfile& profile, const feedrate::RampLimits& limits) {
  feedrate::PathMotion at{profile.phases().front().s, profile.phases().front().v, 0.0};
  for (const feedrate::Phase& phase : profile.phases()) {
    ASSERT_GE(phase.duration, 0.0);
    ASSERT_NEAR(phase.s, at.s, 1e-8);
    ASSERT_NEAR(phase.v, at.v, 1e-6);
    ASSERT_NEAR(phase.a, at.a, 1e-6 * limits.acceleration);
    at = feedrate::motion_at(phase, phase.duration);
    ASSERT_LE(std::abs(at.a), limits.acceleration * (1.0 + 1e-3));
    // A ramp may be 1 nm longer than its room: then it is that much steeper.
    const double slack = 1e-3 + 4e-9 / std::max(at.s - phase.s, 1e-9);
    ASSERT_LE(std::abs(phase.j), limits.jerk * (1.0 + slack));
    ASSERT_GE(at.v, -1e-6);
  }
  ASSERT_NEAR(at.a, 0.0, 1e-6 * limits.acceleration);
}

}  // namespace twin::test

#include "feedrate/certified/glide.hpp"

#include <gtest/gtest.h>

#include "feedrate/paper/envelope.hpp"
#include "tests/support/random_zones.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace glide_test {

using test::expect_feasible;
using test::expect_under_zones;
using test::log_uniform;
using test::MotionProfile;
using test::random_zones;

constexpr RampLimits kTable2{2450.0, 50000.0};

MotionProfile glide(const std::vector<LimitZone>& zones, const RampLimits& limits) {
  Glide glide;
  EXPECT_TRUE(glide.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}, limits));
  return MotionProfile(glide.phases());
}

double envelope_time(const std::vector<LimitZone>& zones, const RampLimits& limits) {
  Envelope envelope(limits);
  EXPECT_TRUE(envelope.plan(zones, {zones.front().begin, 0.0}, {zones.back().end, 0.0}));
  std::vector<Phase> phases;
  for (const Hump& hump : envelope.humps()) {
    append_phases(hump, limits, phases);
  }
  return MotionProfile(phases).duration();
}

TEST(Glide, RestToRestTakesTheClosedForm) {
  const MotionProfile profile = glide({{0.0, 60.0, 50.0}}, kTable2);
  EXPECT_NEAR(profile.duration(), 60.0 / 50.0 + 2.0 * std::sqrt(50.0 / 50000.0), 1e-9);
}

TEST(Glide, RandomZonesAreKept) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto zones = random_zones(random);
    const RampLimits limits = test::random_limits(random);
    const MotionProfile profile = glide(zones, limits);
    ASSERT_FALSE(profile.phases().empty()) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_feasible(profile, limits)) << "case " << i;
    ASSERT_NO_FATAL_FAILURE(expect_under_zones(profile, zones)) << "case " << i;
    const PathMotion end = motion_at(profile.phases().back(), profile.phases().back().duration);
    ASSERT_NEAR(end.s, zones.back().end, 1e-8) << "case " << i;
    ASSERT_NEAR(end.v, 0.0, 1e-6) << "case " << i;
    ASSERT_LE(profile.duration(), envelope_time(zones, limits) * 1.001 + 1e-9) << "case " << i;
  }
}

// A place is known to 1e-9 mm. Beside a corner of a micrometre the limits change in less than that,
// and with a large jerk a ramp passes several of them in one period of a microsecond.
TEST(Glide, StepsShorterThanTheRoundingOfPlacesDoNotKeepItFromPlanning) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const RampLimits limits{100.0, log_uniform(random, 1e7, 1e9)};
    std::vector<LimitZone> zones{{0.0, 1.0, 200.0}};
    const int steps = 40;
    for (int k = -steps; k <= steps; ++k) {
      const double length = log_uniform(random, 2e-10, 1.5e-9);
      const double limit = 1e-3 * std::pow(1.01, std::abs(k));
      zones.push_back({zones.back().end, zones.back().end + length, limit});
    }
    zones.push_back({zones.back().end, zones.back().end + 1.0, 200.0});
    const MotionProfile profile = glide(zones, limits);
    ASSERT_FALSE(profile.phases().empty()) << "case " << i;
    ASSERT_LT(profile.duration(), 0.6) << "case " << i;  // four ramps of 1 mm take 0.4 s
  }
}

}  // namespace glide_test
}  // namespace twin::feedrate

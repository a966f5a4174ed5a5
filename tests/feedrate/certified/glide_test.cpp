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

}  // namespace glide_test
}  // namespace twin::feedrate

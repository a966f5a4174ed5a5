#include <gtest/gtest.h>

#include <limits>

#include "feedrate/profile/phases.hpp"
#include "feedrate/profile/ramps.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace ramp_profile_test {

using test::kProfiles;
using test::log_uniform;

/// The phases of the ramp from v1 to v2 by itself.
std::vector<Phase> phases_of(double v1, double v2, const RampLimits& limits) {
  const double d = ramp_distance(v1, v2, limits);
  std::vector<Phase> phases;
  append_phases({{0.0, v1}, {d, v2}, std::max(v1, v2), v2 > v1 ? d : 0.0, v2 > v1 ? 0.0 : d},
                limits, phases);
  return phases;
}

PathMotion motion_of(const std::vector<Phase>& phases, double t) {
  std::size_t i = 0;
  for (; i + 1 < phases.size() && t > phases[i].duration; ++i) {
    t -= phases[i].duration;
  }
  return motion_at(phases[i], std::min(t, phases[i].duration));
}

RampLimits random_limits(std::mt19937& random, AccelerationProfile profile) {
  RampLimits limits = test::random_limits(random);
  limits.profile = profile;
  return limits;
}

TEST(RampProfile, PhasesKeepAAndJAndEndAtTheOtherFeedrateWithoutAcceleration) {
  std::mt19937 random(1);
  for (int i = 0; i < 30000; ++i) {
    const RampLimits limits = random_limits(random, kProfiles[static_cast<std::size_t>(i) % 3]);
    double v1 = i % 5 == 0 ? 0.0 : log_uniform(random, 1e-2, 300.0);
    double v2 = v1 + log_uniform(random, 1e-3, 500.0);
    if (i % 2 == 0) {
      std::swap(v1, v2);
    }
    double time = 0.0;
    PathMotion at{0.0, v1, 0.0};
    for (const Phase& phase : phases_of(v1, v2, limits)) {
      ASSERT_NEAR(phase.a, at.a, 1e-9 * limits.acceleration);
      ASSERT_LE(std::abs(phase.j), limits.jerk * (1.0 + 1e-9));
      at = motion_at(phase, phase.duration);
      ASSERT_LE(std::abs(at.a), limits.acceleration * (1.0 + 1e-9));
      time += phase.duration;
    }
    ASSERT_NEAR(at.v, v2, 1e-9 * (v1 + v2));
    ASSERT_NEAR(at.a, 0.0, 1e-9 * limits.acceleration);
    ASSERT_NEAR(at.s, ramp_distance(v1, v2, limits), 1e-9 * at.s);
    ASSERT_NEAR(time, ramp_time(v2 - v1, limits), 1e-9 * time);
  }
}

TEST(RampProfile, DistanceUntilAFeedrateIsWhereThePhasesHaveIt) {
  std::mt19937 random(2);
  for (int i = 0; i < 3000; ++i) {
    const RampLimits limits = random_limits(random, kProfiles[static_cast<std::size_t>(i) % 3]);
    const double v1 = i % 5 == 0 ? 0.0 : log_uniform(random, 1e-2, 300.0);
    const double v2 = v1 + log_uniform(random, 1e-2, 500.0);
    const auto phases = phases_of(v1, v2, limits);
    const double tau = ramp_time(v2 - v1, limits);
    for (int k = 0; k <= 10; ++k) {
      const PathMotion at = motion_of(phases, 0.1 * k * tau);
      const double until = ramp_distance_until(v1, v2, std::clamp(at.v, v1, v2), limits);
      ASSERT_NEAR(until, at.s, 1e-5 * phases.back().s) << k;
    }
  }
}

TEST(RampProfile, ReachIsTheLargestFeedrateThatFits) {
  std::mt19937 random(3);
  for (int i = 0; i < 30000; ++i) {
    const RampLimits limits = random_limits(random, kProfiles[static_cast<std::size_t>(i) % 3]);
    const double v1 = i % 7 == 0 ? 0.0 : log_uniform(random, 1e-6, 500.0);
    const double d = log_uniform(random, 1e-6, 1e3);
    const double v2 = ramp_reach(v1, d, limits);
    ASSERT_GE(v2, v1);
    // v2 is right to the last digits; where v1 is large, a ramp of that little has some length.
    constexpr double kDigits = 8.0 * std::numeric_limits<double>::epsilon();
    ASSERT_LE(ramp_distance(v1, std::max(v1, v2 * (1.0 - kDigits)), limits), d * (1.0 + 1e-11));
    ASSERT_GE(ramp_distance(v1, v2 * (1.0 + kDigits), limits), d * (1.0 - 1e-11));
  }
}

TEST(RampProfile, LongestDescentIsThatOfAllRampsDown) {
  std::mt19937 random(4);
  for (int i = 0; i < 3000; ++i) {
    const RampLimits limits = random_limits(random, kProfiles[static_cast<std::size_t>(i) % 3]);
    const double v = log_uniform(random, 1e-1, 500.0);
    const double w_max = v * log_uniform(random, 1e-3, 2.0);
    const double found = longest_descent(v, w_max, limits);
    double longest = 0.0;
    const double highest = std::min(w_max, v * (1.0 - 1e-7));
    for (int k = 0; k <= 1000; ++k) {
      longest = std::max(longest, ramp_distance(v, 1e-3 * k * highest, limits));
    }
    ASSERT_GE(found, longest * (1.0 - 1e-12));
    ASSERT_LE(found, longest * (1.0 + 1e-4)) << "case " << i;
  }
}

TEST(RampProfile, TrapezoidalIsTheFastestAndAllAreTheSameSomewhere) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    RampLimits limits = random_limits(random, AccelerationProfile::kTrapezoidal);
    const double no_hold = limits.acceleration * limits.acceleration / limits.jerk;
    const double d = no_hold * log_uniform(random, 1e-3, 1e3);
    const double fastest = ramp_time(d, limits);
    limits.profile = AccelerationProfile::kSCurve;
    const double s_curve = ramp_time(d, limits);
    limits.profile = AccelerationProfile::kFir;
    const double fir = ramp_time(d, limits);
    // Below A^2/J the S-curve is the trapezoidal ramp, above it the filtered one is.
    ASSERT_NEAR(d < no_hold ? s_curve : fir, fastest, 1e-12 * fastest);
    ASSERT_GT(d < no_hold ? fir : s_curve, fastest);
  }
}

TEST(SCurve, HasNoPhaseOfConstantAccelerationAndReachesAWhereItsJerkIsLowered) {
  const RampLimits limits{2450.0, 50000.0, AccelerationProfile::kSCurve};
  for (const double d : {10.0, 119.0, 121.0, 200.0, 900.0}) {
    const auto phases = phases_of(5.0, 5.0 + d, limits);
    ASSERT_EQ(phases.size(), 2U);
    const double peak = motion_at(phases[0], phases[0].duration).a;
    EXPECT_NEAR(peak, std::min(std::sqrt(50000.0 * d), 2450.0), 1e-6);
    EXPECT_NEAR(phases[0].j, std::min(50000.0, 2450.0 * 2450.0 / d), 1e-6);
  }
}

/// Feedrates of the ramp of constant acceleration from v1 to v2, and their moving average, on a
/// grid of time on which that of the average and that of the ramp are whole numbers of steps: there
/// the trapezoidal rule is exact.
std::vector<double> filtered(double v1, double v2, int ramp_steps, int filter_steps) {
  const auto ramp = [&](int i) {
    return v1 + (v2 - v1) * std::clamp(static_cast<double>(i) / ramp_steps, 0.0, 1.0);
  };
  std::vector<double> average;
  for (int i = 0; i <= ramp_steps + filter_steps; ++i) {
    double sum = 0.0;
    for (int k = i - filter_steps; k < i; ++k) {
      sum += 0.5 * (ramp(k) + ramp(k + 1));
    }
    average.push_back(sum / filter_steps);
  }
  return average;
}

TEST(Fir, IsTheMovingAverageOfTheRampOfConstantAcceleration) {
  std::mt19937 random(6);
  for (int i = 0; i < 100; ++i) {
    const int ramp_steps = static_cast<int>(1 + random() % 300);
    const int filter_steps = static_cast<int>(1 + random() % 300);
    const double acceleration = log_uniform(random, 200.0, 2e4);
    const double dt = log_uniform(random, 1e-5, 1e-3);
    const RampLimits limits{acceleration, acceleration / (filter_steps * dt),
                            AccelerationProfile::kFir};
    double v1 = i % 4 == 0 ? 0.0 : log_uniform(random, 0.1, 200.0);
    double v2 = v1 + acceleration * ramp_steps * dt;
    if (i % 2 == 0) {
      std::swap(v1, v2);
    }
    const auto phases = phases_of(v1, v2, limits);
    const auto average = filtered(v1, v2, ramp_steps, filter_steps);
    for (std::size_t k = 0; k < average.size(); ++k) {
      ASSERT_NEAR(motion_of(phases, static_cast<double>(k) * dt).v, average[k], 1e-9) << k;
    }
  }
}

TEST(Fir, ReachesNoOtherFeedrateWithinTheFiltersTime) {
  const RampLimits limits{2450.0, 50000.0, AccelerationProfile::kFir};
  const double filter = 2450.0 / 50000.0;
  EXPECT_EQ(ramp_reach(50.0, 50.0 * filter * 0.999, limits), 50.0);
  EXPECT_GT(ramp_reach(50.0, 50.0 * filter * 1.001, limits), 50.0);
  EXPECT_EQ(ramp_distance(50.0, 50.0, limits), 0.0);
  EXPECT_NEAR(ramp_distance(50.0, 50.0 + 1e-9, limits), 50.0 * filter, 1e-6);
}

TEST(Fir, HumpWithoutRoomForARampHoldsTheFasterEnd) {
  const RampLimits limits{2450.0, 50000.0, AccelerationProfile::kFir};
  const Hump level = make_hump({0.0, 50.0}, {4.0, 50.0}, 100.0, limits);
  EXPECT_EQ(level.peak, 50.0);
  EXPECT_EQ(level.up + level.down, 0.0);
  const double up = ramp_distance(40.0, 50.0, limits);
  const Hump rising = make_hump({0.0, 40.0}, {up + 2.0, 50.0}, 100.0, limits);
  EXPECT_EQ(rising.peak, 50.0);
  EXPECT_NEAR(rising.up, up, 1e-12);
  EXPECT_EQ(rising.down, 0.0);
}

}  // namespace ramp_profile_test
}  // namespace twin::feedrate

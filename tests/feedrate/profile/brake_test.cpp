#include "feedrate/profile/phases.hpp"

#include <gtest/gtest.h>

#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace brake_test {

struct Case {
  PathMotion from;
  RampLimits limits;
};

/// A state that a motion within the limits can be in: from v it can still avoid going backwards.
Case random_case(std::mt19937& random) {
  Case c;
  c.limits = test::random_limits(random);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  c.from.s = 5.0 * part(random);
  c.from.a = random() % 5 == 0 ? 0.0 : c.limits.acceleration * part(random);
  const double least = c.from.a < 0.0 ? 0.5 * c.from.a * c.from.a / c.limits.jerk : 0.0;
  c.from.v = least + (random() % 5 == 0 ? 0.0 : test::log_uniform(random, 1e-3, 500.0));
  return c;
}

TEST(Brake, EndsAtRestWithoutAcceleration) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Case c = random_case(random);
    const Brake brake = make_brake(c.from, c.limits);
    PathMotion at = c.from;
    for (const Phase& phase : brake.phases) {
      ASSERT_GE(phase.duration, 0.0);
      ASSERT_EQ(phase.s, at.s);
      ASSERT_EQ(phase.v, at.v);
      ASSERT_EQ(phase.a, at.a);
      ASSERT_LE(std::abs(phase.j), c.limits.jerk);
      at = motion_at(phase, phase.duration);
      ASSERT_LE(std::abs(at.a), c.limits.acceleration * (1.0 + 1e-12));
      ASSERT_GE(at.v, -1e-9);
    }
    ASSERT_NEAR(at.v, 0.0, 1e-9 * (1.0 + c.from.v));
    ASSERT_NEAR(at.a, 0.0, 1e-9 * c.limits.acceleration);
    ASSERT_NEAR(brake.distance, at.s - c.from.s, 1e-12);
  }
}

/// Distance to rest of bang-bang braking, one small step of time after the other: jerk down as long
/// as the deceleration then reached can still be taken back in time.
double integrated_distance(const Case& c) {
  const double j = c.limits.jerk;
  const double dt = 1e-5 * (c.from.v / c.limits.acceleration + c.limits.acceleration / j);
  double s = 0.0;
  double v = c.from.v;
  double a = c.from.a;
  while (v > 0.0 || a > 0.0) {
    // Releasing the deceleration from a < 0 loses a^2 / 2J of feedrate.
    const bool must_release = a < 0.0 && v <= 0.5 * a * a / j;
    double next = must_release ? a + j * dt : std::max(a - j * dt, -c.limits.acceleration);
    if (must_release && next >= 0.0) {
      next = 0.0;
      if (a == 0.0) {
        break;
      }
    }
    const double gain = 0.5 * dt * (a + next);
    s += dt * (v + 0.5 * gain);
    v += gain;
    a = next;
  }
  return s;
}

TEST(Brake, CoversTheDistanceOfIntegratedBangBangBraking) {
  std::mt19937 random(2);
  for (int i = 0; i < 60; ++i) {
    const Case c = random_case(random);
    const double expected = integrated_distance(c);
    EXPECT_NEAR(make_brake(c.from, c.limits).distance, expected, 1e-3 * expected + 1e-9);
  }
}

TEST(Brake, FromAHoldIsTheRampToRest) {
  const RampLimits limits{2450.0, 50000.0};
  for (const double v : {0.0, 1.0, 50.0, 120.0, 200.0}) {
    const Brake brake = make_brake({0.0, v, 0.0}, limits);
    EXPECT_NEAR(brake.distance, ramp_distance(v, 0.0, limits), 1e-12);
    EXPECT_NEAR(brake.duration, ramp_time(v, limits), 1e-12);
  }
}

double feedrate_at(const Brake& brake, double s) {
  for (const Phase& phase : brake.phases) {
    if (s <= motion_at(phase, phase.duration).s) {
      return motion_at(phase, time_at(phase, s)).v;
    }
  }
  return 0.0;
}

TEST(Brake, NoOtherMotionWithinTheLimitsIsSlowerAnywhere) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const Case c = random_case(random);
    const Brake brake = make_brake(c.from, c.limits);
    PathMotion other = c.from;
    const double step = brake.duration / 20.0;
    for (int k = 0; k < 40 && other.s < c.from.s + brake.distance; ++k) {
      const double lowest = std::max(-c.limits.jerk, (-c.limits.acceleration - other.a) / step);
      const double highest = std::min(c.limits.jerk, (c.limits.acceleration - other.a) / step);
      const double jerk = std::clamp(c.limits.jerk * (part(random) - 0.7), lowest, highest);
      other = motion_at({step, other.s, other.v, other.a, jerk}, step);
      if (other.v <= 0.0 || (other.a < 0.0 && other.v < 0.5 * other.a * other.a / c.limits.jerk)) {
        break;  // it cannot but go backwards
      }
      ASSERT_GE(other.v, feedrate_at(brake, other.s) - 1e-6 * (1.0 + c.from.v));
    }
  }
}

}  // namespace brake_test
}  // namespace twin::feedrate

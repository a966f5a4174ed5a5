#include "feedrate/bound/jerk_leg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace twin::feedrate {
namespace jerk_leg_test {

const RampLimits kRamp{2450.0, 50000.0};

/// Distance and end of a motion of phases of constant jerk.
struct Motion {
  double s = 0.0, v = 0.0, a = 0.0, t = 0.0, most = 0.0;

  void go(double j, double h) {
    if (a > 0.0 && a + j * h < 0.0) {
      most = std::max(most, v - 0.5 * a * a / j);
    }
    s += h * (v + h * (0.5 * a + h * j / 6.0));
    v += h * (a + 0.5 * h * j);
    a += h * j;
    t += h;
    most = std::max(most, v);
  }
};

TEST(JerkLeg, FromRestToRestIsTheSCurveInClosedForm) {
  // Neither A nor F: four phases of J, L = 2 J t^3.
  const double t = std::cbrt(0.1 / (2.0 * kRamp.jerk));
  EXPECT_NEAR(shortest_time(0.1, 50.0, {}, {}, kRamp), 4.0 * t, 1e-9);
  // F, not A: two ramps of 2 sqrt(F / J), each over F sqrt(F / J).
  const double ramp = std::sqrt(50.0 / kRamp.jerk);
  EXPECT_NEAR(shortest_time(20.0, 50.0, {}, {}, kRamp), 20.0 / 50.0 + 2.0 * ramp, 1e-12);
  // F and A: ramps of F / A + A / J.
  EXPECT_NEAR(shortest_time(80.0, 200.0, {}, {}, kRamp),
              80.0 / 200.0 + 200.0 / 2450.0 + 2450.0 / 50000.0, 1e-12);
}

TEST(JerkLeg, BetweenCornersOfOneFeedrateLosesTheClosedForm) {
  const double f = 50.0;
  const double v = 5.947;  // a corner of 90 degrees; optimum.md's loss 2 (F - v)^1.5 / (F sqrt J)
  EXPECT_NEAR(shortest_time(10.0, f, {v, 0.0}, {v, 0.0}, kRamp) - 10.0 / f,
              2.0 * std::pow(f - v, 1.5) / (f * std::sqrt(kRamp.jerk)), 1e-12);
}

TEST(JerkLeg, ADipTakesTheTimeOfItsAcceleration) {
  const double a = 500.0;
  const double t = a / kRamp.jerk;
  const double length = 2.0 * t * (28.0 - a * a / (3.0 * kRamp.jerk));
  EXPECT_NEAR(shortest_time(length, 28.0, {28.0, -a, -a}, {28.0, -a, -a}, kRamp), 2.0 * t, 1e-9);
}

TEST(JerkLeg, NoRandomMotionIsQuicker) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double nearest = 0.0;
  int count = 0;
  for (int i = 0; i < 200000; ++i) {
    Motion m;
    m.v = 60.0 * part(random);
    m.a = 2450.0 * (2.0 * part(random) - 1.0);
    const Motion begin = m;
    m.most = m.v;
    bool is_kept = true;  // no feedrate below 0
    for (int phase = 0; phase < 1 + i % 6 && is_kept; ++phase) {
      const double j = kRamp.jerk * static_cast<double>(static_cast<int>(3.0 * part(random)) - 1);
      double duration = 0.03 * part(random);
      if (j != 0.0) {  // as long as A allows
        duration = std::min(duration, (kRamp.acceleration - m.a * (j > 0.0 ? 1.0 : -1.0)) / 5e4);
      }
      m.go(j, duration);
      is_kept = m.v >= 0.0;
    }
    const auto can_be = [](const Motion& at) { return at.a * at.a <= 2.0 * kRamp.jerk * at.v; };
    if (!is_kept || m.s <= 1e-6 || !can_be(begin) || !can_be(m)) {
      continue;
    }
    const double cap = m.most;
    const double bound =
        shortest_time(m.s, cap, {begin.v, begin.a, begin.a}, {m.v, -m.a, -m.a}, kRamp);
    ASSERT_LE(bound, m.t * (1.0 + 1e-9) + 1e-9)
        << m.s << " " << cap << " " << begin.v << " " << begin.a << " " << m.v << " " << m.a;
    nearest = std::max(nearest, bound / m.t);
    ++count;
  }
  EXPECT_GT(count, 20000);
  EXPECT_GT(nearest, 0.999);
}

}  // namespace jerk_leg_test
}  // namespace twin::feedrate

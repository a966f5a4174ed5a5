#include "feedrate/limits/axis_limits.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "feedrate/limits/ramp_levels.hpp"
#include "tests/support/s_curve.hpp"

namespace twin::feedrate {
namespace axis_limits_test {

using test::log_uniform;

/// Acceleration of the level of a feedrate.
double allowed(const LimitZone& zone, Sense sense, const RampLimits& ramp, double v) {
  std::vector<RampLevel> levels;
  append_ramp_levels(zone, sense, ramp, levels);
  std::size_t level = 0;
  while (levels[level].top < v) {
    ++level;
  }
  return levels[level].acceleration;
}

TEST(AxisLimits, NoneLeaveAZoneAsItIs) {
  EXPECT_FALSE(has_axis_limits({}));
  LimitZone zone{0.0, 1.0, 50.0};
  keep_axis_limits({Vec3::Ones(), Vec3::Ones(), Vec3::Ones()}, {}, BendKind::kLasting, zone);
  EXPECT_EQ(zone.limit, 50.0);
  EXPECT_TRUE(std::isinf(zone.acceleration));
  EXPECT_TRUE(std::isinf(zone.jerk));
}

TEST(AxisLimits, OnALineEachAxisIsUsedUp) {
  Limits limits;
  limits.axis_feedrate = {30.0, 0.0, 0.0};
  limits.axis_acceleration = {1200.0, 800.0, 0.0};
  limits.axis_jerk = {30000.0, 16000.0, 0.0};
  LimitZone zone{0.0, 1.0, 200.0};
  keep_axis_limits({{0.6, 0.8, 0.0}, Vec3::Zero(), Vec3::Zero()}, limits, BendKind::kLasting, zone);
  EXPECT_DOUBLE_EQ(zone.limit, 50.0);
  EXPECT_DOUBLE_EQ(zone.acceleration, 1000.0);
  EXPECT_DOUBLE_EQ(zone.jerk, 20000.0);
}

// Every part at its largest, with either sign, at twenty feedrates up to the limit: j once had what the
// limit leaves, and below it, where an axis's acceleration allows more of a, v a can be larger.
TEST(AxisLimits, AnyMotionWithinAZoneKeepsEveryAxis) {
  std::mt19937 random(1);
  const auto part = [&] { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); };
  const auto sign = [&] { return std::array{-1.0, 0.0, 1.0}[random() % 3]; };
  for (int i = 0; i < 20000; ++i) {
    Limits limits;
    limits.acceleration = log_uniform(random, 100.0, 1e4);
    limits.jerk = log_uniform(random, 1e3, 1e6);
    const bool has_jerk = random() % 3 != 0;
    for (int axis = 0; axis < 3; ++axis) {
      limits.axis_feedrate[axis] = log_uniform(random, 1.0, 300.0);
      limits.axis_acceleration[axis] = log_uniform(random, 50.0, 1e4);
      limits.axis_jerk[axis] = has_jerk ? log_uniform(random, 1e3, 1e6) : 0.0;
    }
    const double kappa = log_uniform(random, 1e-4, 50.0);
    const double twist = kappa * log_uniform(random, 1e-3, 100.0);
    PathBounds bounds;
    bounds.tangent = Vec3(part(), part(), part()).normalized().cwiseAbs();
    bounds.curvature = kappa * Vec3(part(), part(), part()).normalized().cwiseAbs();
    bounds.twist = twist * Vec3(part(), part(), part()).normalized().cwiseAbs();
    for (int axis = 0; axis < 3; ++axis) {
      bounds.trend[axis] = static_cast<double>(random() % 3) - 1.0;
    }
    LimitZone zone{0.0, 1.0, log_uniform(random, 0.1, 200.0)};
    keep_axis_limits(bounds, limits, random() % 2 == 0 ? BendKind::kBrief : BendKind::kLasting,
                     zone);
    const RampLimits ramp{limits.acceleration, limits.jerk};
    ASSERT_GT(zone.limit, 0.0);
    ASSERT_GT(zone.acceleration, 0.0);
    ASSERT_GT(zone.deceleration, 0.0);
    ASSERT_GT(zone.jerk, 0.0);
    for (int k = 0; k < 20; ++k) {
      const double v = zone.limit * (k + 1) / 20.0;
      const double sense = random() % 2 == 0 ? 1.0 : -1.0;
      const double a =
          sense * allowed(zone, sense > 0.0 ? Sense::kForward : Sense::kBackward, ramp, v);
      const double j = std::min(zone.jerk, limits.jerk) * sign();
      for (int axis = 0; axis < 3; ++axis) {
        const double t = bounds.tangent[axis] * sign();
        const double c = bounds.curvature[axis] * sign();
        const double size = bounds.twist[axis] * sign();
        const double w =
            bounds.trend[axis] == 0.0 ? size : std::copysign(size, bounds.trend[axis] * c);
        ASSERT_LE(std::abs(t * v), limits.axis_feedrate[axis] * (1.0 + 1e-9));
        ASSERT_LE(std::abs(t * a + c * v * v), limits.axis_acceleration[axis] * (1.0 + 1e-9));
        if (has_jerk) {
          ASSERT_LE(std::abs(t * j + 3.0 * c * v * a + w * v * v * v),
                    limits.axis_jerk[axis] * (1.0 + 1e-9));
        }
      }
    }
  }
}

// In a bend of constant curvature the jerk of an axis is 3 k v a: at half of the feedrate twice the
// acceleration is left.
TEST(AxisLimits, AtALowerFeedrateMoreAccelerationIsLeft) {
  Limits limits;
  limits.axis_jerk = {30000.0, 30000.0, 0.0};
  LimitZone zone{0.0, 1.0, 100.0};
  keep_axis_limits({{0.7, 0.7, 0.0}, {1.0, 1.0, 0.0}, Vec3::Zero()}, limits, BendKind::kLasting,
                   zone);
  const RampLimits ramp{limits.acceleration, limits.jerk};
  std::vector<RampLevel> levels;
  append_ramp_levels(zone, Sense::kForward, ramp, levels);
  ASSERT_GE(levels.size(), 5U);
  EXPECT_DOUBLE_EQ(levels.back().acceleration, zone.acceleration);
  EXPECT_GT(levels.front().acceleration, 0.8 * limits.acceleration);
  for (const double v : {0.1, 0.3, 0.6}) {
    const double exact = std::min(zone.acceleration / v, limits.acceleration);
    const double a = allowed(zone, Sense::kForward, ramp, v * zone.limit);
    EXPECT_LE(a, exact * (1.0 + 1e-9));
    EXPECT_GE(a, exact / 1.26);
  }
}

}  // namespace axis_limits_test
}  // namespace twin::feedrate

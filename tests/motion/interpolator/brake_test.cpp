#include <gtest/gtest.h>

#include <random>

#include "following.hpp"
#include "tests/support/random_program.hpp"

namespace twin::motion {
namespace brake_test {

using test::mixed_plan;
using test::place_at_distance;
using test::PlanSource;

constexpr feedrate::RampLimits kLimits{2450.0, 50000.0};

/// Brakes after `steps` set points. Feedrate falls within A and J by its differences, every set
/// point is on the path, and the last one is at rest where the planned motion at this time, and
/// quickest braking from it, end.
void expect_brakes(const test::Plan& plan, double period, std::size_t steps) {
  PlanSource source(plan);
  Interpolator interpolator(source, period);
  SetPoint point;
  for (std::size_t i = 0; i <= steps; ++i) {
    ASSERT_EQ(interpolator.step(point), Status::kMoving);
  }
  double distance = test::distance_at(plan, static_cast<double>(steps) * period);
  const double room = interpolator.braking_distance(kLimits);
  const Vec3 end = place_at_distance(plan, distance + room);
  interpolator.brake(kLimits);
  double v = point.feedrate;
  double a_before = 2.0 * kLimits.acceleration;  // unknown
  std::size_t count = 0;
  Status status = interpolator.step(point);
  for (; status == Status::kMoving; status = interpolator.step(point)) {
    const double a = (point.feedrate - v) / period;
    ASSERT_LE(std::abs(a), kLimits.acceleration * 1.001);
    if (count > 0) {
      ASSERT_LE(std::abs(a - a_before), kLimits.jerk * period * 1.001);
    }
    const double mean = 0.5 * (v + point.feedrate);
    distance += period * mean;  // to J T^3 / 12
    a_before = a;
    v = point.feedrate;
    ASSERT_LT(++count, 100000U);
    ASSERT_LT((point.position - place_at_distance(plan, distance)).norm(),
              1e-6 + static_cast<double>(count) * kLimits.jerk * period * period * period / 6.0);
  }
  ASSERT_EQ(status, Status::kAtRest) << "after " << steps;
  ASSERT_EQ(point.feedrate, 0.0);
  ASSERT_LT((point.position - end).norm(), 1e-6);
}

TEST(InterpolatorBrake, ComesToRestOnThePathFromEveryPeriod) {
  for (const double period : {1e-3, 4e-3}) {
    const auto plan = mixed_plan(period);
    const auto count = test::follow(plan, period).size();
    for (std::size_t steps = 0; steps + 1 < count; ++steps) {
      ASSERT_NO_FATAL_FAILURE(expect_brakes(plan, period, steps))
          << "period " << period << " step " << steps << " of " << count;
    }
  }
}

TEST(InterpolatorBrake, ComesToRestOnThePathOfRandomPrograms) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const auto plan = test::plan(test::random_program(random, 6));
    const auto count = test::follow(plan, 1e-3).size();
    for (int k = 0; k < 10 && count > 2; ++k) {
      const std::size_t steps = random() % (count - 1);
      ASSERT_NO_FATAL_FAILURE(expect_brakes(plan, 1e-3, steps))
          << "program " << i << " step " << steps << " of " << count;
    }
  }
}

TEST(InterpolatorBrake, IsStillAtRestUntilResumed) {
  const auto plan = mixed_plan(1e-3);
  PlanSource source(plan);
  Interpolator interpolator(source, 1e-3);
  SetPoint point;
  for (int i = 0; i < 100; ++i) {
    interpolator.step(point);
  }
  interpolator.brake(kLimits);
  EXPECT_TRUE(interpolator.is_braking());
  while (interpolator.step(point) == Status::kMoving) {
  }
  EXPECT_FALSE(interpolator.is_braking());
  const Vec3 place = point.position;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(interpolator.step(point), Status::kAtRest);
    interpolator.brake(kLimits);
  }
  EXPECT_EQ(point.position, place);
}

TEST(InterpolatorBrake, BeforeTheFirstSetPointIsTheEnd) {
  const auto plan = mixed_plan(1e-3);
  PlanSource source(plan);
  Interpolator interpolator(source, 1e-3);
  interpolator.brake(kLimits);
  SetPoint point;
  EXPECT_EQ(interpolator.step(point), Status::kDone);
}

}  // namespace brake_test
}  // namespace twin::motion

#include "motion/interpolator/set_point.hpp"

#include <gtest/gtest.h>

#include "following.hpp"

namespace twin::motion {
namespace set_point_test {

TEST(SetPoint, VelocityAndAccelerationAreTheDifferencesOfThePositions) {
  const double period = 0.125e-3;
  const auto plan = test::smooth_plan(period);
  for (const auto& planned : plan.segments) {
    ASSERT_TRUE(std::holds_alternative<path::FittedCurve>(planned.segment.geometry));
  }
  const auto points = test::follow(plan, period);
  ASSERT_GT(points.size(), 2000U);
  // Over +-T the third derivative, at most J along and a few v^3 kappa^2 across, errs by T^2 / 6 of
  // it in velocity; a step of it inside errs by T of it in acceleration.
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 velocity = (points[i + 1].position - points[i - 1].position) / (2.0 * period);
    const Vec3 acceleration =
        (points[i + 1].position - 2.0 * points[i].position + points[i - 1].position) /
        (period * period);
    ASSERT_LT((points[i].velocity - velocity).norm(), 1e-3) << i;
    ASSERT_LT((points[i].acceleration - acceleration).norm(), 20.0) << i;
  }
}

TEST(SetPoint, KeepsFeedrateAccelerationAndJerkByItsDifferences) {
  const Limits limits;
  for (const double period : {0.25e-3, 1e-3}) {
    const auto points = test::follow(test::smooth_plan(period), period);
    for (std::size_t i = 2; i + 1 < points.size(); ++i) {
      const Vec3 acceleration =
          (points[i + 1].position - 2.0 * points[i].position + points[i - 1].position) /
          (period * period);
      const Vec3 tangent = (points[i + 1].position - points[i - 1].position).normalized();
      const double along = acceleration.dot(tangent);
      const double across = (acceleration - along * tangent).norm();
      ASSERT_LE((points[i].position - points[i - 1].position).norm(), 50.0 * period * (1 + 1e-9));
      ASSERT_LE(across, 1.02 * limits.acceleration);
      ASSERT_LE(std::abs(along), 1.02 * limits.acceleration);
      const double jerk =
          (points[i + 1].feedrate - 2.0 * points[i].feedrate + points[i - 1].feedrate) /
          (period * period);
      ASSERT_LE(std::abs(jerk), 1.001 * limits.jerk);
    }
  }
}

TEST(SetPoint, NeverExceedsTheLimitItNames) {
  const auto points = test::follow(test::mixed_plan(1e-3), 1e-3);
  for (const SetPoint& point : points) {
    EXPECT_LE(point.feedrate, point.feedrate_limit * (1.0 + 1e-6) + 1e-6);
    EXPECT_NEAR(point.velocity.norm(), point.feedrate, 1e-12);
  }
}

}  // namespace set_point_test
}  // namespace twin::motion

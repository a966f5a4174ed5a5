#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "following.hpp"

// Parameter updates and curve ends of motion::InterpolatorSettings.
namespace twin::motion {
namespace variants_test {

using test::follow;
using test::place_at;
using test::smooth_plan;

constexpr double kPeriod = 1e-3;

/// Largest distance of the set points from where the plan has them at the same time [mm].
double largest_error(ParameterUpdate update, double period) {
  const auto plan = smooth_plan(1e-3);
  InterpolatorSettings settings;
  settings.update = update;
  const auto points = follow(plan, period, 0, settings);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 planned = place_at(plan, static_cast<double>(i) * period);
    largest = std::max(largest, (points[i].position - planned).norm());
  }
  return largest;
}

TEST(ParameterUpdates, ErrorAlongACurveFallsWithTheOrderOfTheUpdate) {
  const double first = largest_error(ParameterUpdate::kTaylor1, kPeriod);
  const double second = largest_error(ParameterUpdate::kTaylor2, kPeriod);
  EXPECT_GT(first, 20.0 * second);
  EXPECT_NEAR(first / largest_error(ParameterUpdate::kTaylor1, kPeriod / 4.0), 4.0, 1.0);
  EXPECT_NEAR(second / largest_error(ParameterUpdate::kTaylor2, kPeriod / 4.0), 16.0, 5.0);
  EXPECT_LT(largest_error(ParameterUpdate::kRungeKutta4, kPeriod), 0.1 * second);
  EXPECT_LT(largest_error(ParameterUpdate::kCorrected, kPeriod), 1e-6);
}

TEST(CurveEnds, LandingPutsASetPointOnEveryCurvesEnd) {
  const auto plan = smooth_plan(kPeriod);
  InterpolatorSettings settings;
  settings.curve_end = CurveEnd::kLand;
  const auto points = follow(plan, kPeriod, 0, settings);
  for (const feedrate::PlannedSegment& planned : plan.segments) {
    const Vec3 end = planned.segment.end.position;
    EXPECT_TRUE(std::ranges::any_of(points, [&](const SetPoint& p) {
      return (p.position - end).norm() < 1e-12;
    })) << planned.index;
  }
}

TEST(CurveEnds, LandingLosesTheRestOfAPeriodPerCurveAndNothingElse) {
  const auto plan = smooth_plan(kPeriod);
  InterpolatorSettings settings;
  settings.curve_end = CurveEnd::kLand;
  std::size_t periods = 0;
  for (const feedrate::PlannedSegment& planned : plan.segments) {
    double time = 0.0;
    for (const feedrate::Phase& phase : planned.phases) {
      time += phase.duration;
    }
    periods += static_cast<std::size_t>(std::ceil(time / kPeriod));
  }
  const auto points = follow(plan, kPeriod, 0, settings);
  EXPECT_NEAR(static_cast<double>(points.size()), static_cast<double>(periods + 2), 1.0);
  EXPECT_GT(points.size(), follow(plan, kPeriod).size() + plan.segments.size() / 4);
}

TEST(CurveEnds, StepsAreShortWhereACurveEndsAndWholeElsewhere) {
  const auto plan = smooth_plan(kPeriod);
  InterpolatorSettings settings;
  settings.curve_end = CurveEnd::kLand;
  const auto points = follow(plan, kPeriod, 0, settings);
  std::size_t short_steps = 0;
  for (std::size_t i = 100; i + 100 < points.size(); ++i) {
    const double step = (points[i].position - points[i - 1].position).norm();
    const double whole = 0.5 * (points[i].feedrate + points[i - 1].feedrate) * kPeriod;
    if (step < 0.98 * whole) {
      ++short_steps;
      EXPECT_TRUE(points[i + 1].segment == points[i].segment + 1) << i;
    } else {
      EXPECT_NEAR(step, whole, 2e-3 * whole) << i;
    }
  }
  EXPECT_GT(short_steps, plan.segments.size() / 2);
  EXPECT_LE(short_steps, plan.segments.size());
}

TEST(CurveEnds, LandingSurvivesASourceThatStarves) {
  const auto plan = smooth_plan(kPeriod);
  InterpolatorSettings settings;
  settings.curve_end = CurveEnd::kLand;
  const auto all = follow(plan, kPeriod, 0, settings);
  const auto starved = follow(plan, kPeriod, 3, settings);
  ASSERT_EQ(all.size(), starved.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].position, starved[i].position) << i;
  }
}

}  // namespace variants_test
}  // namespace twin::motion

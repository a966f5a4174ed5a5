#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "following.hpp"
#include "tests/support/random_program.hpp"

namespace twin::motion {
namespace resume_test {

using test::ReplanSource;

constexpr feedrate::RampLimits kLimits{2450.0, 50000.0};

/// Brakes after each of the given numbers of set points, goes on by another plan after each rest,
/// and goes to the end.
std::vector<SetPoint> follow_with_rests(const test::Plan& plan, double period,
                                        const std::vector<std::size_t>& rests) {
  ReplanSource source(plan, period);
  Interpolator interpolator(source, period);
  std::vector<SetPoint> points;
  SetPoint point;
  for (std::size_t guard = 0; guard < 1000000; ++guard) {
    const Status status = interpolator.step(point);
    if (status == Status::kDone) {
      return points;
    }
    if (status == Status::kStarved) {
      break;
    }
    if (status == Status::kAtRest) {
      const PlanPlace place = interpolator.place();
      interpolator.adopt(source.plan_from(place.segment, place.s, 0.0));
      interpolator.resume();
      continue;
    }
    points.push_back(point);
    if (std::find(rests.begin(), rests.end(), points.size()) != rests.end()) {
      interpolator.brake(kLimits);
    }
  }
  ADD_FAILURE() << "never ends";
  return points;
}

TEST(Resume, FromAnyPeriodGoesOnToTheSameEnd) {
  const double period = 2e-3;
  const auto plan = test::mixed_plan(period);
  const auto whole = test::follow(plan, period);
  for (std::size_t steps = 1; steps < whole.size(); ++steps) {
    const auto points = follow_with_rests(plan, period, {steps});
    ASSERT_LT((points.back().position - whole.back().position).norm(), 1e-8) << steps;
    ASSERT_EQ(points.back().block, whole.back().block) << steps;
    ASSERT_EQ(points.back().feedrate, 0.0);
  }
}

TEST(Resume, AgainAndAgainGoesOnToTheSameEndOfRandomPrograms) {
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    const auto plan = test::plan(test::random_program(random, 6));
    const auto whole = test::follow(plan, 1e-3);
    std::vector<std::size_t> rests;
    for (int k = 0; k < 8; ++k) {
      rests.push_back(1 + random() % whole.size());
    }
    const auto points = follow_with_rests(plan, 1e-3, rests);
    ASSERT_LT((points.back().position - whole.back().position).norm(), 1e-8) << "program " << i;
  }
}

TEST(Resume, KeepsTheLimits) {
  const double period = 1e-3;
  const auto plan = test::mixed_plan(period);
  const auto count = test::follow(plan, period).size();
  for (std::size_t steps = 20; steps + 1 < count; steps += 37) {
    const auto points = follow_with_rests(plan, period, {steps});
    for (std::size_t i = 2; i < points.size(); ++i) {
      const double a = (points[i].feedrate - points[i - 1].feedrate) / period;
      const double before = (points[i - 1].feedrate - points[i - 2].feedrate) / period;
      ASSERT_LE(points[i].feedrate, points[i].feedrate_limit * (1.0 + 1e-6) + 1e-6);
      ASSERT_LE(std::abs(a), 1.001 * kLimits.acceleration);
      ASSERT_LE(std::abs(a - before), 1.001 * kLimits.jerk * period) << steps << " " << i;
    }
  }
}

TEST(Resume, DoesNotCutADwellShort) {
  const double period = 1e-3;
  const auto plan = test::mixed_plan(period);
  std::int64_t rest = 0;
  for (const auto& planned : plan.segments) {
    rest = planned.segment.dwell > 0.0 ? planned.index : rest;
  }
  const auto is_resting = [&](const SetPoint& point) { return point.segment == rest; };
  const auto whole = test::follow(plan, period);
  const auto first = static_cast<std::size_t>(std::find_if(whole.begin(), whole.end(), is_resting) -
                                              whole.begin());
  for (std::size_t steps = first - 60; steps <= first + 45; ++steps) {
    const auto points = follow_with_rests(plan, period, {steps});
    EXPECT_GE(std::count_if(points.begin(), points.end(), is_resting), 49)
        << "brake at " << steps << ", dwell from " << first;
  }
}

}  // namespace resume_test
}  // namespace twin::motion

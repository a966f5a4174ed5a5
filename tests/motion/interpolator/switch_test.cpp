#include <gtest/gtest.h>

#include "following.hpp"

// Another plan goes on from a place of the present one.
namespace twin::motion {
namespace switch_test {

using feedrate::PlannedSegment;
using test::ReplanSource;

constexpr double kPeriod = 1e-3;  // [s]

/// Holds of a plan: phases without acceleration or jerk, in motion.
std::vector<PlanSwitch> holds_of(const test::Plan& plan) {
  std::vector<PlanSwitch> holds;
  for (const PlannedSegment& planned : plan.segments) {
    for (std::size_t i = 0; i < planned.phases.size(); ++i) {
      const feedrate::Phase& phase = planned.phases[i];
      if (phase.a == 0.0 && phase.j == 0.0 && phase.v > 0.0) {
        holds.push_back({0, planned.index, i, 0.37 * phase.duration});
      }
    }
  }
  return holds;
}

/// Follows a plan, leaves it at a place for one that is the same from there on.
std::vector<SetPoint> follow_with_switch(const test::Plan& plan, PlanSwitch at) {
  ReplanSource source(plan, kPeriod);
  Interpolator interpolator(source, kPeriod);
  const auto& planned = plan.segments[static_cast<std::size_t>(at.segment)];
  const feedrate::PathMotion m = feedrate::motion_at(planned.phases[at.phase], at.time);
  at.plan = source.plan_from(at.segment, m.s, m.v);
  std::vector<SetPoint> points;
  SetPoint point;
  EXPECT_FALSE(interpolator.arm(at));  // not before it has started
  for (int i = 0; i < 100000; ++i) {
    const Status status = interpolator.step(point);
    if (status != Status::kMoving) {
      EXPECT_EQ(status, Status::kDone);
      break;
    }
    points.push_back(point);
    if (i == 0) {
      EXPECT_TRUE(interpolator.arm(at));
      EXPECT_EQ(interpolator.latest_plan(), at.plan);
    }
  }
  EXPECT_EQ(interpolator.plan(), at.plan);
  return points;
}

TEST(Switch, AnEqualPlanGivesEqualSetPoints) {
  const auto plan = test::mixed_plan(kPeriod);
  const auto whole = test::follow(plan, kPeriod);
  const auto holds = holds_of(plan);
  ASSERT_GT(holds.size(), 5U);
  for (const PlanSwitch& at : holds) {
    const auto points = follow_with_switch(plan, at);
    ASSERT_EQ(points.size(), whole.size()) << at.segment;
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_LT((points[i].position - whole[i].position).norm(), 1e-7) << at.segment << " " << i;
      ASSERT_EQ(points[i].line, whole[i].line) << i;
      ASSERT_EQ(points[i].segment, whole[i].segment) << i;
    }
  }
}

TEST(Switch, APlaceThatHasBeenPassedIsRefused) {
  const auto plan = test::mixed_plan(kPeriod);
  const auto holds = holds_of(plan);
  ReplanSource source(plan, kPeriod);
  Interpolator interpolator(source, kPeriod);
  SetPoint point;
  const PlanSwitch& at = holds.front();
  while (interpolator.step(point) == Status::kMoving && point.segment <= at.segment) {
    const PlanPlace place = interpolator.place();
    const bool is_ahead = place.segment < at.segment || place.phase < at.phase ||
                          (place.phase == at.phase && place.time <= at.time);
    ASSERT_EQ(interpolator.arm(at), is_ahead);
    ASSERT_TRUE(interpolator.arm(holds.back()));  // never reached here
  }
  EXPECT_FALSE(interpolator.arm(at));
}

TEST(Switch, BrakingAcrossThePlaceGoesOnByTheOtherPlan) {
  const auto plan = test::mixed_plan(kPeriod);
  const auto whole = test::follow(plan, kPeriod);
  for (PlanSwitch at : holds_of(plan)) {
    ReplanSource source(plan, kPeriod);
    Interpolator interpolator(source, kPeriod);
    const auto& phases = plan.segments[static_cast<std::size_t>(at.segment)].phases;
    const feedrate::PathMotion m = feedrate::motion_at(phases[at.phase], at.time);
    at.plan = source.plan_from(at.segment, m.s, m.v);
    SetPoint point;
    ASSERT_EQ(interpolator.step(point), Status::kMoving);
    ASSERT_TRUE(interpolator.arm(at));
    Status status = Status::kMoving;
    bool is_near = false;
    while (!is_near && status == Status::kMoving) {
      status = interpolator.step(point);
      is_near = interpolator.place().segment == at.segment &&
                interpolator.place().s > m.s - 2.0 * kPeriod * m.v;
    }
    interpolator.brake({2450.0, 50000.0});
    while (status == Status::kMoving) {
      status = interpolator.step(point);
    }
    ASSERT_EQ(status, Status::kAtRest);
    const PlanPlace place = interpolator.place();
    interpolator.adopt(source.plan_from(place.segment, place.s, 0.0));
    interpolator.resume();
    while (interpolator.step(point) == Status::kMoving) {
    }
    ASSERT_LT((point.position - whole.back().position).norm(), 1e-8) << at.segment;
  }
}

}  // namespace switch_test
}  // namespace twin::motion

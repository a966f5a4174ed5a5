#include <gtest/gtest.h>

#include "following.hpp"
#include "tests/support/allocations.hpp"

namespace twin::motion {
namespace {

TEST(Allocation, IsCountedHere) {
  const std::int64_t before = test::allocations();
  delete new std::vector<double>(100);
  EXPECT_GE(test::allocations() - before, 1);
}

TEST(Allocation, AStepNeedsNoneWhetherMovingBrakingOrGoingOnByAnotherPlan) {
  const auto plan = test::mixed_plan(1e-3);
  test::ReplanSource source(plan, 1e-3);
  Interpolator interpolator(source, 1e-3);
  SetPoint point;
  std::int64_t allocated = 0;
  const auto counted = [&](const auto& call) {
    const std::int64_t before = test::allocations();
    call();
    allocated += test::allocations() - before;
  };
  int steps = 0;
  int rests = 0;
  for (Status status = Status::kMoving; status != Status::kDone && steps < 100000; ++steps) {
    counted([&] { status = interpolator.step(point); });
    if (steps % 300 == 200) {
      counted([&] { interpolator.brake({2450.0, 50000.0}); });
    }
    if (status == Status::kAtRest) {
      const PlanPlace place = interpolator.place();
      const std::int64_t other = source.plan_from(place.segment, place.s, 0.0);
      counted([&] {
        interpolator.adopt(other);
        interpolator.resume();
      });
      ++rests;
    }
  }
  EXPECT_EQ(allocated, 0);
  EXPECT_GT(rests, 2);
  EXPECT_GT(steps, 1000);
}

}  // namespace
}  // namespace twin::motion

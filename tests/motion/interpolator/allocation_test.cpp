#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "following.hpp"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: g++ would see free() meet memory of operator new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace twin::motion {
namespace {

TEST(Allocation, IsCountedHere) {
  const long before = allocations;
  delete new std::vector<double>(100);
  EXPECT_GE(allocations - before, 1);
}

TEST(Allocation, AStepNeedsNoneWhetherMovingBrakingOrGoingOnByAnotherPlan) {
  const auto plan = testing::mixed_plan(1e-3);
  testing::ReplanSource source(plan, 1e-3);
  Interpolator interpolator(source, 1e-3);
  SetPoint point;
  long allocated = 0;
  const auto counted = [&](const auto& call) {
    const long before = allocations;
    call();
    allocated += allocations - before;
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

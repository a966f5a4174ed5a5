#include "runtime/segment_queue.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace twin::runtime {
namespace segment_queue_test {

feedrate::PlannedSegment segment(std::int64_t index, double length = 1.0) {
  feedrate::PlannedSegment planned;
  planned.index = index;
  planned.segment.length = length;
  planned.phases.resize(7);
  return planned;
}

void wait_until(const std::function<bool()>& condition) {
  while (!condition()) {
    std::this_thread::yield();
  }
}

TEST(SegmentQueue, HandsSegmentsOverInOrderBetweenTwoThreads) {
  constexpr std::int64_t kCount = 20000;
  SegmentQueue queue(16);
  std::jthread planner([&] {
    for (std::int64_t i = 0; i < kCount; ++i) {
      EXPECT_TRUE(queue.push(segment(i, static_cast<double>(i))));
    }
    queue.close();
  });
  std::int64_t next = 0;
  while (!queue.is_finished()) {
    if (const feedrate::PlannedSegment* planned = queue.next()) {
      ASSERT_EQ(planned->index, next);
      ASSERT_EQ(planned->segment.length, static_cast<double>(next));
      ASSERT_EQ(planned->phases.size(), 7U);
      queue.release(planned);
      ++next;
    }
  }
  EXPECT_EQ(next, kCount);
  EXPECT_EQ(queue.next(), nullptr);
}

TEST(SegmentQueue, MakesThePlannerWaitWhileItIsFull) {
  SegmentQueue queue(4);
  std::atomic<std::int64_t> pushed{0};
  std::jthread planner([&] {
    for (std::int64_t i = 0; i < 50; ++i) {
      queue.push(segment(i));
      ++pushed;
    }
    queue.close();
  });
  // Nobody takes any: the planner gets no further than the room there is.
  wait_until([&] { return queue.is_primed(); });
  std::int64_t taken = 0;
  while (!queue.is_finished()) {
    if (const feedrate::PlannedSegment* planned = queue.next()) {
      EXPECT_LE(pushed.load(), taken + 5);
      queue.release(planned);
      ++taken;
    }
  }
  EXPECT_EQ(taken, 50);
}

TEST(SegmentQueue, ASegmentInHandIsNotOverwrittenByThePlanner) {
  SegmentQueue queue(2);
  std::jthread planner([&] {
    for (std::int64_t i = 0; i < 100; ++i) {
      queue.push(segment(i));
    }
    queue.close();
  });
  const feedrate::PlannedSegment* held = nullptr;
  std::int64_t next = 0;
  while (!queue.is_finished()) {
    const feedrate::PlannedSegment* planned = queue.next();
    if (planned == nullptr) {
      continue;
    }
    ASSERT_EQ(planned->index, next);
    if (held != nullptr) {
      ASSERT_EQ(held->index, next - 1);
      queue.release(held);
    }
    held = planned;
    ++next;
  }
  EXPECT_EQ(next, 100);
}

TEST(SegmentQueue, StopLetsAWaitingPlannerGo) {
  SegmentQueue queue(2);
  std::atomic<bool> was_refused{false};
  std::jthread planner([&] {
    std::int64_t i = 0;
    while (queue.push(segment(i++))) {
    }
    was_refused = true;
  });
  wait_until([&] { return queue.is_primed(); });
  queue.stop();
  planner.join();
  EXPECT_TRUE(was_refused);
}

TEST(SegmentQueue, IsPrimedWhenFullOrComplete) {
  SegmentQueue queue(3);
  EXPECT_FALSE(queue.is_primed());
  queue.push(segment(0));
  EXPECT_FALSE(queue.is_primed());
  queue.push(segment(1));
  queue.push(segment(2));
  EXPECT_TRUE(queue.is_primed());

  SegmentQueue complete(3);
  complete.push(segment(0));
  EXPECT_FALSE(complete.is_primed());
  complete.close();
  EXPECT_TRUE(complete.is_primed());
  EXPECT_FALSE(complete.is_finished());
  complete.release(complete.next());
  EXPECT_TRUE(complete.is_finished());
}

TEST(SegmentQueue, KnowsHowFarThePathIsKnown) {
  SegmentQueue queue(8);
  EXPECT_EQ(queue.reach(0), 0.0);
  queue.push(segment(0, 1.5));
  queue.push(segment(1, 2.25));
  EXPECT_EQ(queue.reach(0), 3.75);
  queue.release(queue.next());
  EXPECT_EQ(queue.reach(0), 3.75);
  queue.set_reach(1, 2.0);
  EXPECT_EQ(queue.reach(1), 2.0);
  EXPECT_EQ(queue.reach(0), 3.75);
}

TEST(SegmentQueue, AnotherPlanPassesOverWhatIsLeftOfTheOneBefore) {
  SegmentQueue queue(8);
  for (std::int64_t i = 0; i < 4; ++i) {
    queue.push(segment(i));
  }
  queue.close(0);
  feedrate::PlannedSegment other = segment(1);
  other.plan = 1;
  EXPECT_TRUE(queue.try_push(other, 1, 2.0));
  const feedrate::PlannedSegment* first = queue.next();
  EXPECT_EQ(first->index, 0);
  queue.adopt(1);
  EXPECT_FALSE(queue.is_finished());
  const feedrate::PlannedSegment* next = queue.next();
  ASSERT_NE(next, nullptr);
  EXPECT_EQ(next->index, 1);
  EXPECT_EQ(next->plan, 1);
  EXPECT_FALSE(queue.is_finished());
  queue.close(1);
  EXPECT_TRUE(queue.is_finished());
  // Those that were passed over are free again: the buffer takes a whole round.
  queue.release(first);
  queue.release(next);
  for (std::int64_t i = 0; i < 9; ++i) {
    feedrate::PlannedSegment more = segment(i);
    more.plan = 1;
    EXPECT_TRUE(queue.try_push(more, 1, 0.0)) << i;
  }
}

}  // namespace segment_queue_test
}  // namespace twin::runtime

#include "core/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace twin {
namespace bounded_queue_test {

TEST(BoundedQueue, ItemsArriveOnceAndInOrder) {
  BoundedQueue<int> queue(2);
  std::jthread producer([&] {
    for (int i = 0; i < 1000; ++i) {
      queue.push(i);
    }
    queue.close();
  });
  for (int i = 0; i < 1000; ++i) {
    ASSERT_EQ(queue.pop(), i);
  }
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, AClosedQueueGivesBackWhatItHoldsAndTakesNoMore) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.push(1));
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_EQ(queue.pop(), 1);
  EXPECT_EQ(queue.pop(), std::nullopt);
}

TEST(BoundedQueue, ClosingFreesAWaitingProducer) {
  BoundedQueue<int> queue(1);
  queue.push(1);
  bool was_taken = true;
  std::jthread producer([&] { was_taken = queue.push(2); });
  queue.close();
  producer.join();
  EXPECT_FALSE(was_taken);
}

}  // namespace bounded_queue_test
}  // namespace twin

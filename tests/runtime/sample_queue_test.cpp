#include "runtime/sample_queue.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace twin::runtime {
namespace sample_queue_test {

/// Every sample comes in its order, through a queue that is much too small.
void expect_all_pass(SampleQueue::Waiting waiting) {
  constexpr std::int64_t kSamples = 20000;
  SampleQueue queue(8, waiting);
  const std::jthread motion([&] {
    results::Sample sample;
    for (std::int64_t i = 0; i < kSamples; ++i) {
      sample.line = i;
      while (!queue.push(sample)) {
        if (waiting == SampleQueue::Waiting::kAwake) {
          queue.wait_for_room();
        } else {
          std::this_thread::yield();
        }
      }
    }
    queue.close();
  });
  std::int64_t next = 0;
  results::Sample sample;
  do {
    while (queue.pop(sample)) {
      ASSERT_EQ(sample.line, next++);
    }
    queue.show_room();
  } while (queue.wait_for_samples());
  EXPECT_EQ(next, kSamples);
}

TEST(SampleQueue, PassesEverySampleWhereEachWakesTheOther) {
  expect_all_pass(SampleQueue::Waiting::kAwake);
}

TEST(SampleQueue, PassesEverySampleWhereTheRecorderPolls) {
  expect_all_pass(SampleQueue::Waiting::kPoll);
}

TEST(SampleQueue, IsOverOnceClosedAndEmpty) {
  SampleQueue queue(8, SampleQueue::Waiting::kAwake);
  ASSERT_TRUE(queue.push({}));
  queue.close();
  EXPECT_TRUE(queue.wait_for_samples());
  results::Sample sample;
  EXPECT_TRUE(queue.pop(sample));
  EXPECT_FALSE(queue.wait_for_samples());
}

}  // namespace sample_queue_test
}  // namespace twin::runtime

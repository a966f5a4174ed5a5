#include "core/parallel_for.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace twin {
namespace parallel_for_test {

TEST(ParallelFor, EveryIndexIsVisitedOnceWithAnyNumberOfThreads) {
  for (const unsigned threads : {0U, 1U, 2U, 7U}) {
    for (const std::size_t count : {0U, 1U, 3U, 1000U}) {
      std::vector<std::atomic<int>> visits(count);
      parallel_for(
          count, [&](std::size_t i) { ++visits[i]; }, threads);
      for (const std::atomic<int>& visit : visits) {
        EXPECT_EQ(visit, 1);
      }
    }
  }
}

TEST(ParallelFor, AnExceptionReachesTheCaller) {
  EXPECT_THROW(parallel_for(
                   100,
                   [](std::size_t i) {
                     if (i == 42) {
                       throw std::runtime_error("42");
                     }
                   },
                   3),
               std::runtime_error);
}

}  // namespace parallel_for_test
}  // namespace twin

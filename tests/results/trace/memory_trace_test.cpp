#include <gmock/gmock.h>

#include <array>
#include <stdexcept>

#include "twin/trace.hpp"

namespace twin {
namespace memory_trace_test {

using ::testing::ElementsAre;

TEST(MemoryTrace, HasItsColumnsByName) {
  MemoryTrace trace;
  EXPECT_EQ(trace.size(), 0U);
  ASSERT_FALSE(trace.begin({.columns = {{.name = "t_s"}, {.name = "x_mm"}}, .period = 0.002}));
  ASSERT_FALSE(trace.rows(std::array{0.0, 5.0, 0.002, 6.0}));
  ASSERT_FALSE(trace.rows(std::array{0.004, 7.0}));
  EXPECT_EQ(trace.header().period, 0.002);
  EXPECT_EQ(trace.size(), 3U);
  EXPECT_TRUE(trace.has("x_mm"));
  EXPECT_FALSE(trace.has("y_mm"));
  EXPECT_THAT(trace["t_s"], ElementsAre(0.0, 0.002, 0.004));
  EXPECT_THAT(trace["x_mm"], ElementsAre(5.0, 6.0, 7.0));
  EXPECT_THROW(trace["y_mm"], std::out_of_range);
}

TEST(MemoryTrace, IsCompleteOnceCommittedAndBeginsAnewWithTheNextRun) {
  MemoryTrace trace;
  ASSERT_FALSE(trace.begin({.columns = {{.name = "t_s"}}}));
  ASSERT_FALSE(trace.rows(std::array{0.0}));
  EXPECT_FALSE(trace.is_complete());
  ASSERT_FALSE(trace.commit());
  EXPECT_TRUE(trace.is_complete());
  ASSERT_FALSE(trace.begin({.columns = {{.name = "t_s"}}}));
  EXPECT_FALSE(trace.is_complete());
  EXPECT_EQ(trace.size(), 0U);
}

}  // namespace memory_trace_test
}  // namespace twin

#include "hal/rig/guard/heartbeat_timer.hpp"

#include <gtest/gtest.h>

namespace twin::hal::rig::guard {
namespace heartbeat_timer_test {

using namespace std::chrono_literals;

TEST(HeartbeatTimer, IsLateOnlyBeyondTheTimeout) {
  HeartbeatTimer timer(20ms);
  EXPECT_FALSE(timer.is_late(100ms, 7, true));
  EXPECT_FALSE(timer.is_late(120ms, 7, true));
  EXPECT_TRUE(timer.is_late(121ms, 7, true));
  EXPECT_FALSE(timer.is_late(122ms, 8, true));
}

TEST(HeartbeatTimer, EveryBeatStartsTheTimeAnew) {
  HeartbeatTimer timer(20ms);
  for (int i = 0; i < 100; ++i) {
    EXPECT_FALSE(timer.is_late(i * 20ms, static_cast<std::uint64_t>(i), true));
  }
}

TEST(HeartbeatTimer, SilenceBeforeBeatsAreExpectedDoesNotCount) {
  HeartbeatTimer timer(20ms);
  EXPECT_FALSE(timer.is_late(0ms, 0, false));
  EXPECT_FALSE(timer.is_late(500ms, 0, false));
  EXPECT_FALSE(timer.is_late(501ms, 0, true));
  EXPECT_FALSE(timer.is_late(521ms, 0, true));
  EXPECT_TRUE(timer.is_late(522ms, 0, true));
}

TEST(HeartbeatTimer, CountThatWrapsIsABeat) {
  HeartbeatTimer timer(20ms);
  EXPECT_FALSE(timer.is_late(0ms, ~std::uint64_t{0}, true));
  EXPECT_FALSE(timer.is_late(20ms, 0, true));
  EXPECT_FALSE(timer.is_late(40ms, 0, true));
}

}  // namespace heartbeat_timer_test
}  // namespace twin::hal::rig::guard

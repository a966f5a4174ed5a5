#include "hal/rig/guard/guard.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <functional>
#include <thread>

namespace twin::hal::rig::guard {
namespace guard_test {

using namespace std::chrono_literals;

/// Waits until something is so, at most ten seconds.
bool becomes(const std::function<bool()>& is_so) {
  for (int i = 0; i < 10000; ++i) {
    if (is_so()) {
      return true;
    }
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// The guard's loop in a thread; the test is the controller.
class GuardLoop : public ::testing::Test {
 protected:
  ~GuardLoop() override { hang_up(); }

  void start(std::chrono::milliseconds timeout) {
    ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
    guard =
        std::jthread([this, timeout] { run_guard(page, ends[0], timeout, [this] { ++safe; }); });
    ASSERT_TRUE(becomes([&] { return page.state == GuardState::kWatching; }));
  }
  /// What the kernel does when the controller's process ends, whatever ended it.
  void hang_up() {
    if (ends[1] >= 0) {
      close(ends[1]);
      ends[1] = -1;
    }
    if (guard.joinable()) {
      guard.join();
      close(ends[0]);
    }
  }
  void wait_for_turns(std::uint64_t turns) {
    const std::uint64_t from = page.turns;
    ASSERT_TRUE(becomes([&] { return page.turns >= from + turns; }));
  }

  GuardPage page;
  std::atomic<int> safe{0};
  std::array<int, 2> ends{-1, -1};
  std::jthread guard;
};

TEST_F(GuardLoop, ControllerThatEndsWhileArmedIsMadeSafe) {
  start(1h);
  page.is_armed = true;
  wait_for_turns(5);
  EXPECT_EQ(safe, 0);
  hang_up();
  EXPECT_GE(safe, 1);
  EXPECT_EQ(page.state, GuardState::kActed);
}

TEST_F(GuardLoop, ControllerThatEndsDisarmedIsLeftAlone) {
  start(1h);
  page.is_armed = true;
  wait_for_turns(2);
  page.is_armed = false;
  hang_up();
  EXPECT_EQ(safe, 0);
  EXPECT_EQ(page.state, GuardState::kWatching);
}

TEST_F(GuardLoop, SilentControllerIsMadeSafeInEveryTurn) {
  start(20ms);
  page.is_armed = true;
  ASSERT_TRUE(becomes([&] { return page.state == GuardState::kActed; }));
  // The controller wakes up: too late.
  page.heartbeats += 10;
  const int before = safe;
  wait_for_turns(5);
  EXPECT_GE(safe, before + 4);
}

TEST_F(GuardLoop, UnarmedControllerMayBeSilent) {
  start(1ms);
  wait_for_turns(30);
  EXPECT_EQ(safe, 0);
  EXPECT_EQ(page.state, GuardState::kWatching);
}

TEST_F(GuardLoop, BeatingControllerIsLeftAlone) {
  start(10s);
  page.is_armed = true;
  for (int i = 0; i < 50; ++i) {
    ++page.heartbeats;
    wait_for_turns(1);
  }
  EXPECT_EQ(safe, 0);
}

}  // namespace guard_test
}  // namespace twin::hal::rig::guard

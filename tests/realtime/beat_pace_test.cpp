#include "runtime/pace.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace twin::runtime {
namespace beat_pace_test {

RealtimeSettings settings() {
  RealtimeSettings settings;
  settings.max_late_periods = 3;
  settings.max_stall = 0.1;
  return settings;
}

TEST(BeatClock, APeriodAfterTheOtherIsPunctualHoweverLongItTook) {
  BeatClock clock(0.001);
  Pacer pacer(clock, 0.001, settings(), Schedule::kKept);
  for (int i = 0; i < 5; ++i) {
    clock.beat(1);
    const WakeUp wake_up = pacer.wait();
    EXPECT_EQ(wake_up.missed, 0);
    EXPECT_LT(wake_up.latency, 0.001);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the machine's time is stretched
  }
  EXPECT_EQ(pacer.late_periods(), 0);
  EXPECT_FALSE(pacer.overrun());
}

TEST(BeatClock, PeriodsThatTheMachineCountedMeanwhileAreMissed) {
  BeatClock clock(0.001);
  Pacer pacer(clock, 0.001, settings(), Schedule::kKept);
  clock.beat(1);
  pacer.wait();
  clock.beat(4);
  const WakeUp wake_up = pacer.wait();
  EXPECT_EQ(wake_up.missed, 3);
  EXPECT_EQ(pacer.late_periods(), 1);
  clock.beat(1);
  EXPECT_EQ(pacer.wait().missed, 0);
  EXPECT_FALSE(pacer.overrun());
}

TEST(BeatClock, TooManyAtOnceAreAStall) {
  BeatClock clock(0.001);
  Pacer pacer(clock, 0.001, settings(), Schedule::kKept);
  clock.beat(1);
  pacer.wait();
  clock.beat(150);
  pacer.wait();
  ASSERT_TRUE(pacer.overrun());
  EXPECT_EQ(pacer.overrun()->kind, motion::Kind::kStall);
}

}  // namespace beat_pace_test
}  // namespace twin::runtime

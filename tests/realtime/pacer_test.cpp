#include "runtime/pacer.hpp"

#include <gtest/gtest.h>

#include "tests/realtime/fake_clock.hpp"

namespace twin::runtime {
namespace pacer_test {

constexpr std::int64_t kMs = 1'000'000;  // [ns]

struct PacerTest : public ::testing::Test {
  PacerTest() {
    settings.max_late_periods = 3;
    settings.max_stall = 0.1;
  }
  /// The sleep of one number ends late.
  void delay(std::int64_t number, std::int64_t by) {
    clock.lateness = [=](std::int64_t n) { return n == number ? by : 0; };
  }
  test::FakeClock clock;
  RealtimeSettings settings;
};

TEST_F(PacerTest, WakesUpAtTheMultiplesHoweverLongThePeriodsWorkTook) {
  Pacer pacer(clock, 0.001, settings);
  const std::int64_t start = clock.time;
  for (int k = 1; k <= 100; ++k) {
    pacer.wait();
    EXPECT_EQ(clock.time, start + k * kMs);
    clock.time += (k % 7) * kMs / 10;  // work
  }
  EXPECT_EQ(pacer.late_periods(), 0);
}

TEST_F(PacerTest, ALateBeginWithinThePeriodIsMadeUpFor) {
  Pacer pacer(clock, 0.001, settings);
  const std::int64_t start = clock.time;
  delay(1, kMs - 1);
  pacer.wait();
  EXPECT_DOUBLE_EQ(pacer.wait().latency, 0.000999999);
  EXPECT_EQ(pacer.late_periods(), 0);
  pacer.wait();
  EXPECT_EQ(clock.time, start + 3 * kMs);
}

TEST_F(PacerTest, ABeginAtTheNextDeadlineIsOneLatePeriodAndShiftsTheSchedule) {
  Pacer pacer(clock, 0.001, settings);
  const std::int64_t start = clock.time;
  delay(1, 5 * kMs + kMs / 2);
  pacer.wait();
  const WakeUp late = pacer.wait();
  EXPECT_NEAR(late.latency, 0.0055, 1e-12);
  EXPECT_NEAR(late.interval, 0.0065, 1e-12);
  EXPECT_NEAR(pacer.since_deadline(), 0.0055, 1e-12);
  EXPECT_EQ(pacer.late_periods(), 1);
  EXPECT_FALSE(pacer.overrun());
  for (int k = 1; k <= 3; ++k) {  // no burst: every further period is a whole one
    EXPECT_NEAR(pacer.wait().interval, 0.001, 1e-12);
    EXPECT_EQ(clock.time, start + 7 * kMs + kMs / 2 + k * kMs);
  }
  EXPECT_EQ(pacer.late_periods(), 1);
  EXPECT_NEAR(pacer.worst_latency(), 0.0055, 1e-12);
}

TEST_F(PacerTest, AScheduleThatIsKeptMissesPeriodsAndStaysOnItsMultiples) {
  Pacer pacer(clock, 0.001, settings, Schedule::kKept);
  const std::int64_t start = clock.time;
  delay(1, 5 * kMs + kMs / 2);
  EXPECT_EQ(pacer.wait().missed, 0);
  const WakeUp late = pacer.wait();
  EXPECT_EQ(late.missed, 5);
  EXPECT_NEAR(late.latency, 0.0055, 1e-12);
  EXPECT_NEAR(pacer.since_deadline(), 0.0055, 1e-12);
  EXPECT_EQ(pacer.wait().missed, 0);
  EXPECT_EQ(clock.time, start + 8 * kMs);
  EXPECT_EQ(pacer.late_periods(), 1);
}

TEST_F(PacerTest, OnlyLatePeriodsInARowAreAnOverrun) {
  Pacer pacer(clock, 0.001, settings);
  clock.lateness = [](std::int64_t n) { return n % 3 == 2 ? 0 : 2 * kMs; };  // two of three
  for (int k = 0; k < 30; ++k) {
    pacer.wait();
    ASSERT_FALSE(pacer.overrun());
  }
  EXPECT_EQ(pacer.late_periods(), 20);
  clock.lateness = [](std::int64_t) { return 2 * kMs; };
  pacer.wait();
  pacer.wait();
  EXPECT_FALSE(pacer.overrun());
  pacer.wait();
  ASSERT_TRUE(pacer.overrun());
  EXPECT_EQ(pacer.overrun()->kind, motion::Kind::kLatePeriods);
  EXPECT_EQ(pacer.overrun()->value, 3.0);
  EXPECT_EQ(reaction_to(pacer.overrun()->kind), motion::Reaction::kControlled);
}

TEST_F(PacerTest, OneStallIsAnOverrun) {
  Pacer pacer(clock, 0.001, settings);
  delay(4, 100 * kMs);
  for (int k = 0; k < 4; ++k) {
    pacer.wait();
    EXPECT_FALSE(pacer.overrun());
  }
  pacer.wait();
  ASSERT_TRUE(pacer.overrun());
  EXPECT_EQ(pacer.overrun()->kind, motion::Kind::kStall);
  EXPECT_NEAR(pacer.overrun()->value, 0.1, 1e-9);
}

}  // namespace pacer_test
}  // namespace twin::runtime

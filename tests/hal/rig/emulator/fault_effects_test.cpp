// What each fault does to the signals that a controller sees and to the table.
#include <gtest/gtest.h>

#include <cmath>

#include "rig_fixture.hpp"

namespace twin::hal::rig::emulator {
namespace fault_effects_test {

using test::EmulatorBench;

constexpr double kScale = 0.010;  // of the encoder [mm/count]

/// A bench whose X axis moves at 25 mm/s, and its Y axis as well.
class FaultEffects : public ::testing::Test {
 protected:
  FaultEffects() : bench(RigSettings{}, {}, test::quiet_table()) {
    bench.write(0.3, 0.3);
    bench.pass(300);
  }

  void strike(FaultKind kind) { bench.rig.inject({kind, kX, 0.0}); }
  double position(Axis axis) const { return bench.rig.truth().table_position[axis]; }
  double velocity(Axis axis) { return bench.rig.plant()->velocity(axis); }
  /// The counter agrees with the shaft to a count.
  bool is_counted(Axis axis) {
    return std::abs(position(axis) - kScale * bench.counts(axis)) < 1.01 * kScale;
  }

  EmulatorBench bench;
  const RigSettings wiring;
};

TEST_F(FaultEffects, AFrozenEncoderStandsWhileTheTableMoves) {
  ASSERT_TRUE(is_counted(kX));
  strike(FaultKind::kEncoderFrozen);
  const int counts = bench.counts(kX);
  const double start = position(kX);
  bench.pass(100);
  EXPECT_EQ(bench.counts(kX), counts);
  EXPECT_GT(position(kX), start + 2.0);
  EXPECT_TRUE(is_counted(kY)) << "the other axis is not touched";
}

TEST_F(FaultEffects, LostCountsAreAJump) {
  strike(FaultKind::kEncoderLostCounts);
  bench.pass(100);
  EXPECT_NEAR(position(kX) / kScale - bench.counts(kX), kLostCounts, 1.01);
}

TEST_F(FaultEffects, ASlippingEncoderLosesAQuarter) {
  const int counts = bench.counts(kX);
  const double start = position(kX);
  strike(FaultKind::kEncoderSlipping);
  bench.pass(200);
  EXPECT_NEAR((bench.counts(kX) - counts) * kScale, 0.75 * (position(kX) - start), 0.02);
}

TEST_F(FaultEffects, SwappedPhasesRunTheOtherWay) {
  const int counts = bench.counts(kX);
  const double start = position(kX);
  strike(FaultKind::kEncoderSwapped);
  bench.pass(200);
  EXPECT_NEAR((bench.counts(kX) - counts) * kScale, -(position(kX) - start), 0.02);
}

TEST_F(FaultEffects, AStuckConverterKeepsItsVoltage) {
  strike(FaultKind::kDacStuck);
  bench.write(0.0, 0.0);
  bench.pass(300);
  EXPECT_NEAR(velocity(kX), 25.0, 0.5);
  EXPECT_NEAR(velocity(kY), 0.0, 0.5);
}

TEST_F(FaultEffects, AReversedReferenceTurnsTheMotorRound) {
  strike(FaultKind::kVrefReversed);
  bench.pass(300);
  EXPECT_NEAR(velocity(kX), -25.0, 0.5);
}

TEST_F(FaultEffects, AnOpenReferenceIsZeroVolts) {
  strike(FaultKind::kVrefOpen);
  bench.pass(300);
  EXPECT_NEAR(velocity(kX), 0.0, 0.5);
}

TEST_F(FaultEffects, WithoutServoOnTheDriveIsNotReady) {
  strike(FaultKind::kServoOnLost);
  bench.pass(1);
  EXPECT_FALSE(bench.input(wiring.axis[kX].ready.channel));
  EXPECT_TRUE(bench.input(wiring.axis[kX].alarm.channel)) << "no alarm";
  EXPECT_TRUE(bench.input(wiring.axis[kY].ready.channel));
}

TEST_F(FaultEffects, AnAlarmTakesTheTorque) {
  strike(FaultKind::kAlarm);
  bench.pass(300);
  EXPECT_FALSE(bench.input(wiring.axis[kX].alarm.channel));
  EXPECT_FALSE(bench.input(wiring.axis[kX].ready.channel));
  EXPECT_LT(std::abs(velocity(kX)), 25.0);
  EXPECT_NEAR(velocity(kY), 25.0, 0.5);
}

TEST_F(FaultEffects, ABrokenAlarmWireIsAnAlarmToTheControllerAlone) {
  strike(FaultKind::kWireBroken);
  bench.pass(100);
  EXPECT_FALSE(bench.input(wiring.axis[kX].alarm.channel));
  EXPECT_TRUE(bench.input(wiring.axis[kX].ready.channel));
  EXPECT_NEAR(velocity(kX), 25.0, 0.5);
}

TEST_F(FaultEffects, AnOpenLimitSwitchStopsItsDirectionOnly) {
  strike(FaultKind::kLimitPositive);
  bench.pass(300);
  EXPECT_FALSE(bench.input(wiring.axis[kX].limit_positive.channel));
  EXPECT_TRUE(bench.input(wiring.axis[kX].limit_negative.channel));
  EXPECT_NEAR(velocity(kX), 0.0, 0.5);
  bench.write(-0.3, 0.0);
  bench.pass(300);
  EXPECT_NEAR(velocity(kX), -25.0, 0.5);
}

TEST_F(FaultEffects, WithoutThePci1716NothingDrivesAndAllReadsOnes) {
  strike(FaultKind::kCardGone1716);
  bench.pass(300);
  EXPECT_EQ(bench.pci1716.read16(0x10), 0xFFFF);
  EXPECT_FALSE(bench.rig.plant()->is_ready(kX));
  EXPECT_FALSE(bench.rig.plant()->is_ready(kY));
  EXPECT_TRUE(is_counted(kX));
}

TEST_F(FaultEffects, WithoutThePci1784TheCountersReadOnesAndTheTableMovesOn) {
  strike(FaultKind::kCardGone1784);
  bench.pass(100);
  EXPECT_EQ(bench.counts(kX), -1);
  EXPECT_EQ(bench.counts(kY), -1);
  EXPECT_NEAR(velocity(kX), 25.0, 0.5);
}

TEST(FaultTime, CountsFromTheFirstTimeTheServoOfTheAxisIsReady) {
  EmulatorBench bench(RigSettings{}, {{FaultKind::kAlarm, kX, 0.1}});
  bench.pass(500);
  EXPECT_EQ(bench.rig.events().written(), 0U) << "servo off: time does not count";
  bench.write(0.0, 0.0);
  bench.pass(500);
  double ready = -1.0;
  double alarm = -1.0;
  for (std::size_t i = 0; i < bench.rig.events().written(); ++i) {
    const Event& event = bench.rig.events()[i];
    if (event.index == kX && event.kind == EventKind::kServoReady) {
      ready = event.plant_time;
    }
    if (event.index == kX && event.kind == EventKind::kFault) {
      alarm = event.plant_time;
    }
  }
  ASSERT_GT(ready, 0.5);
  EXPECT_NEAR(alarm - ready, 0.1, 1e-9);
}

TEST(FaultTime, OfACardCountsFromTheFirstServoThatIsReady) {
  EmulatorBench bench(RigSettings{}, {{FaultKind::kCardGone1784, kX, 0.05}});
  const RigSettings wiring;
  bench.pci1716.write16(0x10, EmulatorBench::line(wiring.axis[kY].servo_on, true));
  bench.pass(60);
  EXPECT_TRUE(bench.rig.boards().pci1784.is_present.load());
  bench.pass(20);
  EXPECT_FALSE(bench.rig.boards().pci1784.is_present.load());
}

TEST(Events, TheReturnToZeroIsToldWithTheTimeOfTheReturn) {
  EmulatorBench bench;
  bench.write(0.5, 0.0);
  bench.pass(100);
  bench.write(0.0, 0.0);  // at 0.1 s
  bench.pass(150);
  bench.write(0.5, 0.0);  // and on again
  bench.pass(5);
  std::vector<Event> seen;
  for (std::size_t i = 0; i < bench.rig.events().written(); ++i) {
    if (const Event& event = bench.rig.events()[i];
        event.kind == EventKind::kDacDriven || event.kind == EventKind::kDacAtZero) {
      seen.push_back(event);
    }
  }
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_EQ(seen[0].kind, EventKind::kDacDriven);
  EXPECT_EQ(seen[1].kind, EventKind::kDacAtZero);
  EXPECT_NEAR(seen[1].plant_time, 0.1, 1e-9);
  EXPECT_EQ(seen[2].kind, EventKind::kDacDriven);
}

TEST(Events, AServoThatCorrectsSingleCountsDoesNotRest) {
  EmulatorBench bench;
  for (int k = 0; k < 20; ++k) {
    bench.write(0.015, 0.0);
    bench.pass(10);
    bench.write(0.0, 0.0);
    bench.pass(30);
  }
  int told = 0;
  for (std::size_t i = 0; i < bench.rig.events().written(); ++i) {
    told += bench.rig.events()[i].kind == EventKind::kDacAtZero ? 1 : 0;
  }
  EXPECT_EQ(told, 0);
}

TEST(Events, AreToldInTheOrderInWhichTheyHappened) {
  std::vector<Event> events(3);
  events[0] = {EventKind::kDacDriven, 0, 0x9000, 0.0, 10};
  events[1] = {EventKind::kServoOff, 1, 0, 0.3, 300};
  events[2] = {EventKind::kDacAtZero, 0, 0x8000, 0.25, 250};
  events = in_order(std::move(events));
  EXPECT_EQ(events[1].kind, EventKind::kDacAtZero);
  EXPECT_EQ(events[2].kind, EventKind::kServoOff);
}

TEST(Events, CrossingZeroIsNoRest) {
  EmulatorBench bench;
  for (int k = 0; k < 200; ++k) {
    bench.write(k % 2 == 0 ? 0.1 : 0.0, 0.0);
    bench.pass(1);
  }
  int told = 0;
  for (std::size_t i = 0; i < bench.rig.events().written(); ++i) {
    told += bench.rig.events()[i].kind == EventKind::kDacAtZero;
  }
  EXPECT_EQ(told, 0);
}

}  // namespace fault_effects_test
}  // namespace twin::hal::rig::emulator

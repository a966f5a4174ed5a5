#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hal/mujoco/mujoco_machine.hpp"
#include "rig_fixture.hpp"
#include "tests/support/allocations.hpp"

namespace twin::hal::rig::emulator {
namespace emulated_rig_test {

using test::EmulatorBench;
using test::kPeriod;

/// Voltages of one axis over time: a slow wave, steps, and what no controller would write [V].
std::vector<double> wild_volts(unsigned seed, int periods) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(-0.4, 0.4);
  std::vector<double> result;
  double base = 0.0;
  for (int k = 0; k < periods; ++k) {
    base = k % 97 == 0 ? step(random) : base;
    result.push_back(0.8 * std::sin(0.006 * k + seed) + base + 0.01 * step(random));
  }
  return result;
}

/// Drives the machine and the boards alike and counts the periods in which they differ.
int differing_periods(const RigSettings& wiring, double sign_x, double sign_y) {
  constexpr int kPeriods = 5000;
  mujoco::MujocoMachine machine(test::default_table());
  EXPECT_TRUE(checked(machine.configure(kPeriod)));
  EXPECT_TRUE(checked(machine.activate()));
  EmulatorBench bench(wiring);
  const std::vector<double> x = wild_volts(3, kPeriods);
  const std::vector<double> y = wild_volts(8, kPeriods);
  int differences = 0;
  std::int64_t farthest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    Inputs inputs;
    EXPECT_EQ(machine.read(inputs), Status::kOk);
    EXPECT_TRUE(bench.rig.advance());
    const bool is_same =
        inputs.counts[kX] == static_cast<std::int64_t>(sign_x) * bench.counts(kX) &&
        inputs.counts[kY] == static_cast<std::int64_t>(sign_y) * bench.counts(kY) &&
        machine.truth().table_position == bench.rig.truth().table_position &&
        inputs.servo_ready[kX] == bench.input(wiring.axis[kX].ready.channel) &&
        inputs.alarm[kX] != bench.input(wiring.axis[kX].alarm.channel);
    differences += is_same ? 0 : 1;
    farthest = std::max(farthest, std::abs(inputs.counts[kX]));
    Outputs outputs;
    outputs.servo_on = {true, true};
    outputs.volts = {x[k], y[k]};
    EXPECT_EQ(machine.write(outputs), Status::kOk);
    bench.write(sign_x * x[k], sign_y * y[k]);
  }
  EXPECT_GT(farthest, 500);
  return differences;
}

TEST(EmulatedRig, IsTheSimulatedTableBitForBit) {
  EXPECT_EQ(differing_periods(RigSettings{}, 1.0, 1.0), 0);
}

TEST(EmulatedRig, ReversedWiresOnlyReverseTheNumbers) {
  RigSettings wiring;
  for (AxisWiring& axis : wiring.axis) {
    axis.vref_reversed = true;
    axis.encoder_reversed = true;
  }
  EXPECT_EQ(differing_periods(wiring, -1.0, -1.0), 0);
}

TEST(EmulatedRig, ExchangedChannelsLeadToTheSameAxes) {
  RigSettings wiring;
  std::swap(wiring.axis[kX].dac, wiring.axis[kY].dac);
  wiring.axis[kX].counter = 3;
  wiring.axis[kX].servo_on = {9, Level::kLow};
  wiring.axis[kX].ready = {12, Level::kHigh};
  EXPECT_EQ(differing_periods(wiring, 1.0, 1.0), 0);
}

TEST(EmulatedRig, TheCodeOfZeroVoltsIsExactlyZero) {
  EmulatorBench bench(RigSettings{}, {}, test::quiet_table());
  bench.write(0.0, 0.0);
  bench.pass(500);
  EXPECT_EQ(bench.rig.truth().table_position[kX], 0.0);
  EXPECT_EQ(bench.rig.truth().table_position[kY], 0.0);
}

TEST(EmulatedRig, SwitchesAndAlarmsStandAtTheirInputs) {
  mujoco::TableParams table = test::default_table();
  table.axis[kX].travel = 10.0;
  EmulatorBench bench(RigSettings{}, {}, table);
  const RigSettings wiring;
  EXPECT_TRUE(bench.input(wiring.axis[kX].alarm.channel)) << "ALM is on while the drive is healthy";
  EXPECT_TRUE(bench.input(wiring.axis[kX].limit_positive.channel)) << "closed";
  EXPECT_FALSE(bench.input(wiring.axis[kX].ready.channel));
  bench.write(1.0, 0.0);
  bench.pass(300);
  EXPECT_TRUE(bench.input(wiring.axis[kX].ready.channel));
  EXPECT_FALSE(bench.input(wiring.axis[kX].limit_positive.channel)) << "open";
  EXPECT_TRUE(bench.input(wiring.axis[kX].limit_negative.channel));
  EXPECT_TRUE(bench.input(wiring.axis[kY].limit_positive.channel));
}

TEST(EmulatedRig, TheOtherPolarityInvertsAnInput) {
  RigSettings wiring;
  wiring.axis[kY].alarm.when = Level::kHigh;
  wiring.axis[kY].ready.when = Level::kLow;
  EmulatorBench bench(wiring);
  EXPECT_FALSE(bench.input(wiring.axis[kY].alarm.channel));
  EXPECT_TRUE(bench.input(wiring.axis[kY].ready.channel));
}

TEST(EmulatedRig, TheResetLineClearsAnAlarm) {
  const RigSettings wiring;
  EmulatorBench bench;
  bench.write(0.0, 0.0);
  bench.pass(50);
  bench.rig.inject({FaultKind::kAlarm, kX, 0.0});
  bench.pass(2);
  EXPECT_FALSE(bench.input(wiring.axis[kX].alarm.channel));
  bench.pci1716.write16(0x10, EmulatorBench::line(wiring.axis[kX].alarm_reset, true));
  bench.pass(1);
  EXPECT_TRUE(bench.input(wiring.axis[kX].alarm.channel));
}

TEST(EmulatedRig, AnalogueInputsSeeTheConverters) {
  EmulatorBench bench;
  bench.write(1.25, -2.5);
  bench.pass(1);
  bench.pci1716.write16(0x06, 0x0001);
  for (const auto& [channel, volts] : {std::pair{0, 1.25}, std::pair{1, -2.5}}) {
    bench.pci1716.write16(0x04, static_cast<std::uint16_t>(channel | channel << 8));
    bench.pci1716.write16(0x02, 0x04);
    bench.pci1716.write16(0x00, 0);
    EXPECT_EQ(bench.pci1716.read16(0x00), Dac(16).code(volts));
  }
}

TEST(EmulatedRig, TheRangeWordDecidesWhatACodeIs) {
  const auto velocity_at = [](std::uint16_t range, std::uint16_t code) {
    EmulatorBench bench(RigSettings{}, {}, test::quiet_table());
    bench.write(0.0, 0.0);
    bench.pci1716.write16(0x0E, range);
    bench.pci1716.write16(0x0A, code);
    bench.pass(200);
    return bench.rig.plant()->velocity(kX);
  };
  constexpr double kMmPerSPerVolt = 500.0 / 60.0 * 10.0;
  EXPECT_NEAR(velocity_at(0x0101, 0x8800), 0.625 * kMmPerSPerVolt, 1.0);    // +-10 V
  EXPECT_NEAR(velocity_at(0x0100, 0x8800), 0.3125 * kMmPerSPerVolt, 1.0);   // +-5 V
  EXPECT_NEAR(velocity_at(0x0102, 0x0800), 0.15625 * kMmPerSPerVolt, 1.0);  // 0 to 5 V
  EXPECT_NEAR(velocity_at(0x0104, 0x8800), 0.0, 1.0);                       // external
}

TEST(EmulatedRig, AReadBackSeesTheTerminalsOfItsDrive) {
  RigSettings wiring;
  wiring.axis[kX].vref_readback = 7;
  wiring.axis[kX].vref_reversed = true;
  EmulatorBench bench(wiring);
  bench.write(1.25, 0.0);
  bench.pass(1);
  EXPECT_EQ(bench.rig.boards().pci1716.analogue_in[0].load(), 1.25F);
  EXPECT_EQ(bench.rig.boards().pci1716.analogue_in[7].load(), -1.25F);
}

TEST(EmulatedRig, TheIndexComesOnceARevolution) {
  EmulatorBench bench(RigSettings{}, {}, test::quiet_table());
  bench.write(0.6, 0.0);  // 50 mm/s, lead 10 mm
  int seen = 0;
  for (int k = 0; k < 2050; ++k) {
    bench.pass(1);
    seen += (bench.pci1784.read32(0x20) & 1U << 8) != 0;
    bench.pci1784.read32(0x24);
  }
  const double turns = bench.rig.truth().table_position[kX] / 10.0;
  EXPECT_EQ(seen, static_cast<int>(std::floor(turns + 0.5)));
  EXPECT_GE(seen, 9);
}

TEST(EmulatedRig, TheIndexIsAtTheSamePlaceFromBothSides) {
  EmulatorBench bench(RigSettings{}, {}, test::quiet_table());
  const auto index_at = [&bench](double volts) {
    bench.pci1784.write32(0x2C, 0x10);  // index resets counter 0
    bench.pci1784.read32(0x24);
    bench.write(volts, 0.0);
    for (int k = 0; k < 1000 && (bench.pci1784.read32(0x20) & 1U << 8) == 0; ++k) {
      bench.pass(1);
    }
    // With the index at count 0 the shaft stands where it says.
    return bench.rig.truth().table_position[kX] - 0.010 * bench.counts(kX);
  };
  const double forward = index_at(0.6);
  bench.pci1784.write32(0x2C, 0);
  bench.pass(30);
  EXPECT_NEAR(forward, 5.0, 0.02) << "half a revolution from where it was switched on";
  EXPECT_NEAR(index_at(-0.6), forward, 0.011);
}

TEST(EmulatedRig, FastEdgesGetLostAtASlowFilter) {
  mujoco::TableParams table = test::quiet_table();
  table.axis[kX].encoder.mm_per_count = 10.0 / 65536.0;  // 16384 pulses a revolution
  EmulatorBench bench(RigSettings{}, {}, table);
  bench.write(6.0, 0.0);  // 3000 rpm: 3.28 MHz of edges, filter 1 MHz
  bench.pass(300);
  EXPECT_GT(bench.rig.lost_edges(), 0U);
  EXPECT_LT(bench.counts(kX) * table.axis[kX].encoder.mm_per_count,
            0.7 * bench.rig.truth().table_position[kX]);
}

TEST(EmulatedRig, CountsAllAtTheFastestFilter) {
  mujoco::TableParams table = test::quiet_table();
  table.axis[kX].encoder.mm_per_count = 10.0 / 65536.0;
  EmulatorBench bench(RigSettings{}, {}, table);
  bench.pci1784.write32(0x24, 0x00010003);
  bench.write(6.0, 0.0);
  bench.pass(300);
  EXPECT_EQ(bench.rig.lost_edges(), 0U);
  EXPECT_NEAR(bench.counts(kX) * table.axis[kX].encoder.mm_per_count,
              bench.rig.truth().table_position[kX], 0.001);
}

TEST(EmulatedRig, APeriodAllocatesNothing) {
  EmulatorBench bench(RigSettings{},
                      {{FaultKind::kAlarm, kX, 0.05}, {FaultKind::kCardGone1784, kX, 0.1}});
  bench.write(0.5, 0.5);
  bench.pass(2);
  const std::int64_t before = test::allocations();
  bench.pass(200);
  EXPECT_EQ(test::allocations(), before);
  EXPECT_GT(bench.rig.events().written(), 3U);
}

TEST(EmulatedRig, PowerOnStartsAgain) {
  EmulatorBench bench;
  bench.write(1.0, 1.0);
  bench.pass(200);
  ASSERT_NE(bench.counts(kX), 0);
  ASSERT_TRUE(bench.rig.power_on(kPeriod));
  EXPECT_EQ(bench.rig.truth().table_position[kX], 0.0);
  EXPECT_EQ(bench.rig.boards().pci1716.dac[0].load(), 0x8000);
  EXPECT_EQ(bench.pci1784.read32(0x00), 0U);
}

}  // namespace emulated_rig_test
}  // namespace twin::hal::rig::emulator

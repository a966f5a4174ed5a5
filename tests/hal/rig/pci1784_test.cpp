#include "hal/rig/pci1784.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "fake_port.hpp"

namespace twin::hal::rig {
namespace pci1784_test {

using test::Access;
using test::FakePort;
using test::wrote;
using ::testing::ElementsAre;

using Counts = std::array<std::int64_t, kCounters>;

TEST(Pci1784, OpensWithModesInterruptsOffClockAndALatch) {
  FakePort port;
  Pci1784(port, RigSettings{}).open();
  EXPECT_THAT(port.writes(),
              ElementsAre(wrote(0x00, 32, 0x193), wrote(0x04, 32, 0x193), wrote(0x08, 32, 0x193),
                          wrote(0x0C, 32, 0x193), wrote(0x20, 32, 0), wrote(0x24, 32, 0x03010003),
                          wrote(0x28, 32, 0x0F)));
}

TEST(Pci1784, ResetsItsCountersWhereTheSettingsSaySo) {
  RigSettings settings;
  settings.reset_counters = true;
  settings.counter_reset_offset = 0x3C;
  settings.counter_mode = 0x103;
  settings.clock_control = 0x1234567;
  FakePort port;
  Pci1784(port, settings).open();
  EXPECT_EQ(port.last(0x3C), 0x0F);
  EXPECT_EQ(port.last(0x0C), 0x103);
  EXPECT_EQ(port.last(0x24), 0x1234567);
}

TEST(Pci1784, LatchesAllCountersWithOneWriteBeforeItReadsAny) {
  FakePort port;
  Pci1784 card(port, RigSettings{});
  card.open();
  port.log.clear();
  Counts counts{};
  ASSERT_TRUE(card.read(counts));
  EXPECT_THAT(port.log,
              ElementsAre(wrote(0x28, 32, 0x0F), Access{'r', 0x00, 32, 0}, Access{'r', 0x04, 32, 0},
                          Access{'r', 0x08, 32, 0}, Access{'r', 0x0C, 32, 0}));
}

TEST(Pci1784, WhereItStoodWhenOpenedIsZero) {
  FakePort port;
  port.answers = {{0x00, 1000}, {0x04, 0x80000000}};
  Pci1784 card(port, RigSettings{});
  card.open();
  port.answers = {{0x00, 1010}, {0x04, 0x7FFFFFFD}};
  Counts counts{};
  ASSERT_TRUE(card.read(counts));
  EXPECT_THAT(counts, ElementsAre(10, -3, 0, 0));
}

// The reference is the path itself in 64 bits; the card shows it modulo 2^32.
TEST(Pci1784, FollowsAnyPathAcrossTheEndsOf32BitsBothWays) {
  std::mt19937_64 random(20250101);
  for (int trial = 0; trial < 200; ++trial) {
    FakePort port;
    port.is_recording = false;
    const auto start = static_cast<std::int64_t>(random());
    Counts path{};
    const auto show = [&] {
      for (std::size_t i = 0; i < kCounters; ++i) {
        port.answers[static_cast<std::uint32_t>(4 * i)] =
            static_cast<std::uint32_t>(start + path[i]);
      }
    };
    show();
    Pci1784 card(port, RigSettings{});
    card.open();
    std::uniform_int_distribution<std::int64_t> step(-0x7FFFFFFF, 0x7FFFFFFF);
    const std::int64_t drift = trial % 2 == 0 ? 0x3FFFFFFF : -0x3FFFFFFF;
    for (int k = 0; k < 100; ++k) {
      for (std::size_t i = 0; i < kCounters; ++i) {
        path[i] += i == 0 ? drift : step(random);
      }
      show();
      Counts counts{};
      ASSERT_TRUE(card.read(counts));
      ASSERT_EQ(counts, path);
    }
    EXPECT_GT(std::abs(path[0]), std::int64_t{1} << 36);
  }
}

TEST(Pci1784, IndexMarksAreTakenOnceAndClearedByReading) {
  FakePort port;
  Pci1784 card(port, RigSettings{});
  card.open();
  port.answers[0x20] = 0x80000500;
  port.log.clear();
  EXPECT_EQ(card.take_index(), 0x5);
  EXPECT_THAT(port.log, ElementsAre(Access{'r', 0x20, 32, 0x80000500}, Access{'r', 0x24, 32, 0}));
  port.answers[0x20] = 0x000F00FF;
  port.log.clear();
  EXPECT_EQ(card.take_index(), 0);
  EXPECT_EQ(port.log.size(), 1u) << "nothing to clear";
}

TEST(Pci1784, DoesNotLookForIndexMarksWhereTheSettingsSaySo) {
  RigSettings settings;
  settings.read_index = false;
  FakePort port;
  port.answers[0x20] = 0xF00;
  Pci1784 card(port, settings);
  EXPECT_EQ(card.take_index(), 0);
  EXPECT_TRUE(port.log.empty());
}

TEST(Pci1784, DigitalInputsAreBits7To4) {
  FakePort port;
  port.answers[0x30] = 0xFFFFFF9F;
  EXPECT_EQ(Pci1784(port, RigSettings{}).digital_in(), 0x9);
}

TEST(Pci1784, AllCountersAtMinusOneAreNoCardThatIsGone) {
  FakePort port;
  Pci1784 card(port, RigSettings{});
  card.open();
  for (const std::uint32_t offset : {0x00, 0x04, 0x08, 0x0C}) {
    port.answers[offset] = 0xFFFFFFFF;
  }
  port.answers[0x28] = 3;
  Counts counts{};
  EXPECT_TRUE(card.read(counts));
  EXPECT_THAT(counts, ElementsAre(-1, -1, -1, -1));
  EXPECT_EQ(card.board_id(), 3);
}

TEST(Pci1784, AllOnesEverywhereIsACardThatIsGone) {
  FakePort port;
  Pci1784 card(port, RigSettings{});
  card.open();
  port.is_gone = true;
  Counts counts{};
  EXPECT_FALSE(card.read(counts));
  EXPECT_EQ(card.board_id(), -1);
  EXPECT_EQ(card.take_index(), 0);
}

}  // namespace pci1784_test
}  // namespace twin::hal::rig

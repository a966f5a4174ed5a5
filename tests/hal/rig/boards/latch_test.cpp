#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"

namespace twin::hal::rig::boards {
namespace latch_test {

TEST(Latch, AllCountersAreOfOneInstantWhileTheyRun) {
  const auto boards = std::make_unique<BoardRegisters>();
  Pci1784Registers& card = boards->pci1784;
  EmulatedPci1784 port(card);
  for (std::uint32_t counter = 0; counter < 4; ++counter) {
    port.write32(4 * counter, 0x193);
  }
  std::atomic<bool> stop{false};
  std::thread wires([&] {
    for (std::uint32_t n = 1; !stop.load(); ++n) {
      set_running_counters(card, {n, 2 * n, 3 * n, 5 * n});
    }
  });
  int torn = 0;
  std::uint32_t last = 0;
  int changes = 0;
  for (int i = 0; i < 50'000 || (changes < 100 && i < 100'000'000); ++i) {
    port.write32(0x28, 0x0F);
    const std::uint32_t n = port.read32(0x00);
    torn += port.read32(0x04) != 2 * n || port.read32(0x08) != 3 * n || port.read32(0x0C) != 5 * n;
    changes += n != last;
    last = n;
  }
  stop.store(true);
  wires.join();
  EXPECT_EQ(torn, 0);
  EXPECT_GE(changes, 100);
}

TEST(Latch, AWriterKilledInTheMiddleLeavesWholeCountersAndBlocksNobody) {
  const auto boards = std::make_unique<BoardRegisters>();
  Pci1784Registers& card = boards->pci1784;
  EmulatedPci1784 port(card);
  port.write32(0x00, 0x193);
  port.write32(0x04, 0x193);
  set_running_counters(card, {7, 8, 0, 0});
  // The first half of a change, as set_running_counters() begins one.
  card.sequence.store(card.sequence.load() + 1);
  card.running[0][0].store(1000);
  port.write32(0x28, 0x3);
  EXPECT_EQ(port.read32(0x00), 7U);
  EXPECT_EQ(port.read32(0x04), 8U);
  // The next writer puts things right.
  set_running_counters(card, {20, 21, 0, 0});
  port.write32(0x28, 0x3);
  EXPECT_EQ(port.read32(0x00), 20U);
  EXPECT_EQ(port.read32(0x04), 21U);
}

}  // namespace latch_test
}  // namespace twin::hal::rig::boards

// Registers of the PCI-1784 as the drivers of others describe them.
#include <gtest/gtest.h>

#include <memory>

#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"

namespace twin::hal::rig::boards {
namespace emulated_pci1784_test {

class EmulatedPci1784Board : public ::testing::Test {
 protected:
  EmulatedPci1784Board() { power_on(*boards, 0, 9); }

  void run_to(CounterValues values) { set_running_counters(card, values); }

  std::unique_ptr<BoardRegisters> boards = std::make_unique<BoardRegisters>();
  Pci1784Registers& card = boards->pci1784;
  EmulatedPci1784 port{card};
};

TEST_F(EmulatedPci1784Board, AReadShowsTheLatchedCounterAndNotTheRunningOne) {
  port.write32(0x00, 0x193);
  run_to({100, 0, 0, 0});
  EXPECT_EQ(port.read32(0x00), 0U);
  port.write32(0x28, 0x1);
  run_to({250, 0, 0, 0});
  EXPECT_EQ(port.read32(0x00), 100U);
  port.write32(0x28, 0x1);
  EXPECT_EQ(port.read32(0x00), 250U);
}

TEST_F(EmulatedPci1784Board, TheStrobeLatchesCounterByCounter) {
  for (std::uint32_t counter = 0; counter < 4; ++counter) {
    port.write32(4 * counter, 0x193);
  }
  run_to({11, 12, 13, 14});
  port.write32(0x28, 0b0101);
  EXPECT_EQ(port.read32(0x00), 11U);
  EXPECT_EQ(port.read32(0x04), 0U);
  EXPECT_EQ(port.read32(0x08), 13U);
  EXPECT_EQ(port.read32(0x0C), 0U);
}

TEST_F(EmulatedPci1784Board, ACounterWithoutSoftwareLatchIgnoresTheStrobe) {
  port.write32(0x00, 0x093);  // bit 8 clear
  port.write32(0x04, 0x193);
  run_to({11, 12, 0, 0});
  port.write32(0x28, 0x0F);
  EXPECT_EQ(port.read32(0x00), 0U);
  EXPECT_EQ(port.read32(0x04), 12U);
}

TEST_F(EmulatedPci1784Board, TheModeIsNotReadBack) {
  port.write32(0x04, 0x193);
  EXPECT_EQ(card.mode[1].load(), 0x193U);
  EXPECT_EQ(port.read32(0x04), 0U);
}

TEST_F(EmulatedPci1784Board, AResetMakesCountersZeroAtOnce) {
  port.write32(0x00, 0x193);
  port.write32(0x04, 0x193);
  run_to({500, 600, 0, 0});
  port.write32(0x2C, 0x1);
  port.write32(0x28, 0x3);
  EXPECT_EQ(port.read32(0x00), 0U);
  EXPECT_EQ(port.read32(0x04), 600U);
  run_to({497, 600, 0, 0});
  port.write32(0x28, 0x3);
  EXPECT_EQ(static_cast<std::int32_t>(port.read32(0x00)), -3);
}

TEST_F(EmulatedPci1784Board, TheResetCanBeElsewhere) {
  EmulatedPci1784 other(card, {.reset = 0x34, .compare = 0x10});
  other.write32(0x00, 0x193);
  run_to({500, 0, 0, 0});
  other.write32(0x34, 0x1);
  other.write32(0x28, 0x1);
  EXPECT_EQ(other.read32(0x00), 0U);
}

TEST_F(EmulatedPci1784Board, ReadingTheClockClearsTheInterruptStatus) {
  card.interrupt_status.store(0x00000101);
  EXPECT_EQ(port.read32(0x20) & 0x7FFFFFFF, 0x00000101U);
  EXPECT_EQ(port.read32(0x20) & 0x7FFFFFFF, 0x00000101U) << "reading it alone changes nothing";
  port.read32(0x24);
  EXPECT_EQ(port.read32(0x20), 0U);
}

TEST_F(EmulatedPci1784Board, TheMasterBitIsSetWhileAnEnabledSourceIs) {
  card.interrupt_status.store(0x00000100);
  port.write32(0x20, 0x80000001);
  EXPECT_EQ(port.read32(0x20) >> 31, 0U);
  port.write32(0x20, 0x80000100);
  EXPECT_EQ(port.read32(0x20) >> 31, 1U);
  port.write32(0x20, 0x00000100);
  EXPECT_EQ(port.read32(0x20) >> 31, 0U);
}

TEST_F(EmulatedPci1784Board, BoardIdAndInputsAreInTheirBits) {
  card.digital_in.store(0x6);
  EXPECT_EQ(port.read32(0x28) & 0xF, 9U);
  EXPECT_EQ(port.read32(0x30) >> 4 & 0xF, 0x6U);
}

TEST_F(EmulatedPci1784Board, AccessesOfTheWrongWidthAreRefused) {
  EXPECT_EQ(port.read16(0x00), 0xFFFF);
  EXPECT_EQ(port.read8(0x28), 0xFF);
  EXPECT_EQ(port.read32(0x02), 0xFFFFFFFF);
  EXPECT_EQ(port.read32(0x40), 0xFFFFFFFF);
  port.write16(0x00, 0x193);
  port.write8(0x00, 0x93);
  EXPECT_EQ(card.mode[0].load(), 0U);
  EXPECT_EQ(port.rejected(), 6);
  port.write16(0x32, 0x0003);
  EXPECT_EQ(card.digital_mode.load(), 0x0003);
  EXPECT_EQ(port.rejected(), 6) << "the one word there is";
}

TEST_F(EmulatedPci1784Board, AnAbsentCardReadsAllOnesAndTakesNothing) {
  card.is_present.store(false);
  port.write32(0x00, 0x193);
  EXPECT_EQ(card.mode[0].load(), 0U);
  for (std::uint32_t offset = 0; offset < 0x40; offset += 4) {
    EXPECT_EQ(port.read32(offset), 0xFFFFFFFF);
  }
}

}  // namespace emulated_pci1784_test
}  // namespace twin::hal::rig::boards

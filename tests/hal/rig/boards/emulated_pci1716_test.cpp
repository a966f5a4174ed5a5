// Registers of the PCI-1716 as its users' manual and the drivers of others describe them.
#include <gtest/gtest.h>

#include <memory>

#include "hal/rig/boards/emulated_pci1716.hpp"

namespace twin::hal::rig::boards {
namespace emulated_pci1716_test {

class EmulatedPci1716Board : public ::testing::Test {
 protected:
  EmulatedPci1716Board() { power_on(*boards, 5, 0); }

  /// Fetches one sample of a channel, as MUX, range, trigger, poll, read.
  std::uint16_t convert(int channel, std::uint16_t gain) {
    port.write16(0x06, 0x0001);
    port.write16(0x08, 0);
    port.write16(0x04, static_cast<std::uint16_t>(channel | channel << 8));
    port.write16(0x02, gain);
    port.write16(0x00, 0);
    EXPECT_EQ(port.read16(0x06) & 0x0100, 0) << "the FIFO has a sample";
    return port.read16(0x00);
  }

  std::unique_ptr<BoardRegisters> boards = std::make_unique<BoardRegisters>();
  Pci1716Registers& card = boards->pci1716;
  EmulatedPci1716 port{card};
};

TEST_F(EmulatedPci1716Board, ConvertersAndRangeTakeWords) {
  port.write16(0x0A, 0x1234);
  port.write16(0x0C, 0xFEDC);
  port.write16(0x0E, 0x0101);
  EXPECT_EQ(card.dac[0].load(), 0x1234);
  EXPECT_EQ(card.dac[1].load(), 0xFEDC);
  EXPECT_EQ(card.dac_range.load(), 0x0101);
}

TEST_F(EmulatedPci1716Board, WhatCanOnlyBeWrittenDoesNotReadBack) {
  for (std::uint32_t offset : {0x02U, 0x04U, 0x0AU, 0x0CU, 0x0EU}) {
    for (int value : {0x0000, 0x0101, 0x8000, 0xFFFF}) {
      port.write16(offset, static_cast<std::uint16_t>(value));
      EXPECT_NE(port.read16(offset), value) << offset;
    }
  }
}

TEST_F(EmulatedPci1716Board, DigitalOutputsAndInputsShareAnOffset) {
  card.digital_in.store(0x00A5);
  port.write16(0x10, 0xC003);
  EXPECT_EQ(card.digital_out.load(), 0xC003);
  EXPECT_EQ(port.read16(0x10), 0x00A5);
}

TEST_F(EmulatedPci1716Board, BoardIdIsInTheLowFourBits) {
  EXPECT_EQ(port.read16(0x14) & 0x000F, 5);
}

TEST_F(EmulatedPci1716Board, AccessesOfTheWrongWidthAreRefused) {
  port.write16(0x0C, 0x8000);
  port.write16(0x0E, 0x0101);
  port.write32(0x0C, 0x00000000);  // would be both the data and the range
  port.write8(0x0A, 0x00);
  port.write16(0x0B, 0x0000);
  port.write16(0x20, 0x0000);
  EXPECT_EQ(card.dac[0].load(), 0x8000);
  EXPECT_EQ(card.dac[1].load(), 0x8000);
  EXPECT_EQ(card.dac_range.load(), 0x0101);
  EXPECT_EQ(port.rejected(), 4);
  EXPECT_EQ(port.read8(0x10), 0xFF);
  EXPECT_EQ(port.read32(0x10), 0xFFFFFFFF);
  EXPECT_EQ(port.read16(0x11), 0xFFFF);
  EXPECT_EQ(port.rejected(), 7);
}

TEST_F(EmulatedPci1716Board, AnAbsentCardReadsAllOnesAndTakesNothing) {
  card.is_present.store(false);
  port.write16(0x0A, 0x1234);
  port.write16(0x10, 0x0001);
  EXPECT_EQ(card.dac[0].load(), 0x8000);
  EXPECT_EQ(card.digital_out.load(), 0);
  for (std::uint32_t offset = 0; offset < 0x20; offset += 2) {
    EXPECT_EQ(port.read16(offset), 0xFFFF);
  }
  EXPECT_EQ(port.error(), 0) << "the bus answers, the card does not";
}

TEST_F(EmulatedPci1716Board, SamplesAreOffsetBinaryOfTheRange) {
  card.analogue_in[3].store(2.5F);
  EXPECT_EQ(convert(3, 0x04), 0xA000);  // +-10 V
  EXPECT_EQ(convert(3, 0x00), 0xC000);  // +-5 V
  EXPECT_EQ(convert(3, 0x01), 0xFFFF);  // +-2.5 V
  EXPECT_EQ(convert(3, 0x10), 0x4000);  // 0 to 10 V
  EXPECT_EQ(convert(3, 0x11), 0x8000);  // 0 to 5 V
  card.analogue_in[3].store(-2.5F);
  EXPECT_EQ(convert(3, 0x04), 0x6000);
  EXPECT_EQ(convert(3, 0x10), 0x0000);
}

TEST_F(EmulatedPci1716Board, ADifferentialInputIsEvenLessOdd) {
  card.analogue_in[4].store(3.0F);
  card.analogue_in[5].store(0.5F);
  EXPECT_EQ(convert(4, 0x24), 0xA000);
}

TEST_F(EmulatedPci1716Board, NothingIsConvertedWithoutTheSoftwareTrigger) {
  port.write16(0x06, 0x0000);
  port.write16(0x00, 0);
  EXPECT_NE(port.read16(0x06) & 0x0100, 0);
}

TEST_F(EmulatedPci1716Board, AScanGoesFromStartToStopAndAgain) {
  for (std::size_t i = 0; i < 16; ++i) {
    card.analogue_in[i].store(static_cast<float>(i) * 0.625F);
  }
  port.write16(0x06, 0x0001);
  for (int channel = 6; channel <= 8; ++channel) {
    port.write16(0x04, static_cast<std::uint16_t>(channel | channel << 8));
    port.write16(0x02, 0x04);
  }
  port.write16(0x04, 0x0806);
  for (int i = 0; i < 4; ++i) {
    port.write16(0x00, 0);
  }
  for (int channel : {6, 7, 8, 6}) {
    EXPECT_EQ(port.read16(0x00), 0x8000 + channel * 2048);
  }
  EXPECT_NE(port.read16(0x06) & 0x0100, 0);
}

TEST_F(EmulatedPci1716Board, TheFifoTellsHowFullItIs) {
  port.write16(0x06, 0x0001);
  EXPECT_EQ(port.read16(0x06) & 0x0700, 0x0100);
  const auto fill = [this](int samples) {
    for (int i = 0; i < samples; ++i) {
      port.write16(0x00, 0);
    }
  };
  fill(511);
  EXPECT_EQ(port.read16(0x06) & 0x0700, 0x0000);
  fill(1);
  EXPECT_EQ(port.read16(0x06) & 0x0700, 0x0200);
  fill(512);
  EXPECT_EQ(port.read16(0x06) & 0x0700, 0x0600);
  port.write8(0x09, 0);
  EXPECT_EQ(port.read16(0x06) & 0x0700, 0x0100);
}

TEST_F(EmulatedPci1716Board, ControlShowsInTheLowBitsOfTheStatus) {
  port.write16(0x06, 0x0025);
  EXPECT_EQ(port.read16(0x06) & 0x007F, 0x0025);
}

TEST_F(EmulatedPci1716Board, ClearsAreBytesOrOneWord) {
  port.write16(0x06, 0x0001);
  port.write16(0x00, 0);
  port.write8(0x08, 0);
  EXPECT_EQ(port.read16(0x06) & 0x0100, 0) << "the interrupt alone";
  port.write16(0x08, 0);
  EXPECT_NE(port.read16(0x06) & 0x0100, 0) << "interrupt and FIFO";
  EXPECT_EQ(port.rejected(), 0);
}

}  // namespace emulated_pci1716_test
}  // namespace twin::hal::rig::boards

#include "hal/rig/pci1716.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "fake_port.hpp"

namespace twin::hal::rig {
namespace pci1716_test {

using test::Access;
using test::FakePort;
using test::wrote;
using ::testing::ElementsAre;

constexpr std::uint16_t kSafe = 0x000A;

TEST(MakeSafe, IsZeroVoltsThenRangeThenZeroVoltsThenDigitalOutputs) {
  FakePort port;
  make_safe(port, kSafe);
  EXPECT_THAT(port.log, ElementsAre(wrote(0x0A, 16, 0x8000), wrote(0x0C, 16, 0x8000),
                                    wrote(0x0E, 16, 0x0101), wrote(0x0A, 16, 0x8000),
                                    wrote(0x0C, 16, 0x8000), wrote(0x10, 16, kSafe)));
}

TEST(Pci1716, OpensWithTheDrivesOffBeforeTheConvertersAreTouched) {
  FakePort port;
  Pci1716(port, kSafe).open();
  EXPECT_THAT(port.log,
              ElementsAre(wrote(0x10, 16, kSafe), wrote(0x0A, 16, 0x8000), wrote(0x0C, 16, 0x8000),
                          wrote(0x0E, 16, 0x0101), wrote(0x0A, 16, 0x8000), wrote(0x0C, 16, 0x8000),
                          wrote(0x10, 16, kSafe)));
}

TEST(Pci1716, CodesAreThoseOfTheManualsTable) {
  struct Row {
    double volts;
    std::uint32_t code;
  };
  const double lsb = 20.0 / 65536.0;
  for (const Row& row :
       {Row{-10.0, 0x0000}, Row{-lsb, 0x7FFF}, Row{0.0, 0x8000}, Row{lsb, 0x8001},
        Row{10.0 - lsb, 0xFFFF}, Row{10.0, 0xFFFF}, Row{1e9, 0xFFFF}, Row{-1e9, 0x0000},
        Row{5.0, 0xC000}, Row{-5.0, 0x4000}, Row{std::numeric_limits<double>::quiet_NaN(), 0x8000},
        Row{std::numeric_limits<double>::infinity(), 0x8000}}) {
    FakePort port;
    Pci1716(port, kSafe).set_volts(0, row.volts);
    EXPECT_THAT(port.log, ElementsAre(wrote(0x0A, 16, row.code))) << row.volts << " V";
    FakePort other;
    Pci1716(other, kSafe).set_volts(1, row.volts);
    EXPECT_THAT(other.log, ElementsAre(wrote(0x0C, 16, row.code))) << row.volts << " V";
  }
}

TEST(Pci1716, NeitherCodeZeroNorAWideWriteReachesAConverterUnasked) {
  FakePort port;
  {
    Pci1716 card(port, kSafe);
    card.open();
    card.set_volts(0, 1.0);
    card.set_volts(1, -1.0);
    card.set_digital(0xFFFF);
    port.answers[0x06] = 0x0000;
    card.read_volts(3);
    card.make_safe();
  }
  for (const Access& access : port.writes()) {
    EXPECT_EQ(access.bits, 16) << std::hex << access.offset;
    if (access.offset == 0x0A || access.offset == 0x0C) {
      EXPECT_NE(access.value, 0u);
    }
    if (access.offset == 0x0E) {
      EXPECT_EQ(access.value, 0x0101u) << "the range stays";
    }
  }
}

TEST(Pci1716, DigitalOutputsAreWrittenOnlyWhereTheyChange) {
  FakePort port;
  Pci1716 card(port, kSafe);
  card.open();
  port.log.clear();
  card.set_digital(kSafe);
  card.set_digital(0x0005);
  card.set_digital(0x0005);
  EXPECT_THAT(port.log, ElementsAre(wrote(0x10, 16, 0x0005)));
  EXPECT_EQ(card.digital_out(), 0x0005);
  card.make_safe();
  port.log.clear();
  card.set_digital(0x0005);
  EXPECT_THAT(port.log, ElementsAre(wrote(0x10, 16, 0x0005))) << "made safe in between";
}

TEST(Pci1716, ReadsItsInputsAndItsSwitch) {
  FakePort port;
  port.answers = {{0x10, 0xA5C3}, {0x14, 0xFFF7}};
  Pci1716 card(port, kSafe);
  EXPECT_EQ(card.digital_in(), 0xA5C3);
  EXPECT_EQ(card.board_id(), 7);
  EXPECT_FALSE(card.is_gone());
}

TEST(Pci1716, AllOnesEverywhereIsACardThatIsGone) {
  FakePort port;
  port.is_gone = true;
  Pci1716 card(port, kSafe);
  EXPECT_EQ(card.board_id(), -1);
  EXPECT_TRUE(card.is_gone());
  EXPECT_FALSE(card.read_volts(0));
}

TEST(Pci1716, AllInputsHighIsNoCardThatIsGone) {
  FakePort port;
  port.answers = {{0x10, 0xFFFF}, {0x14, 0xFFFF}, {0x06, 0x0100}};
  EXPECT_FALSE(Pci1716(port, kSafe).is_gone());
}

TEST(Pci1716, ConvertsOneAnalogueInputInTheRightOrder) {
  FakePort port;
  port.answers = {{0x06, 0x0000}, {0x00, 0xC000}};
  const auto volts = Pci1716(port, kSafe).read_volts(5);
  ASSERT_TRUE(volts);
  EXPECT_DOUBLE_EQ(*volts, 5.0);
  EXPECT_THAT(port.writes(),
              ElementsAre(wrote(0x06, 16, 1), wrote(0x04, 16, 0x0505), wrote(0x02, 16, 0x04),
                          wrote(0x08, 16, 0), wrote(0x00, 16, 0)));
  EXPECT_DOUBLE_EQ(*Pci1716(port, kSafe).read_volts(5, Pci1716::InputRange::k1V25), 0.625);
}

TEST(Pci1716, AConverterThatNeverAnswersIsPolledForABoundedTime) {
  FakePort port;
  port.answers = {{0x06, 0x0100}};
  EXPECT_FALSE(Pci1716(port, kSafe).read_volts(0));
  EXPECT_LE(port.log.size(), 200u);
}

}  // namespace pci1716_test
}  // namespace twin::hal::rig

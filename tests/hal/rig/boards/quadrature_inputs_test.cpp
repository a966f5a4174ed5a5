#include "hal/rig/boards/quadrature_inputs.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "hal/rig/boards/emulated_pci1784.hpp"

namespace twin::hal::rig::boards {
namespace quadrature_inputs_test {

class Quadrature : public ::testing::Test {
 protected:
  Quadrature() {
    power_on(*boards, 0, 0);
    port.write32(0x00, 0x193);
    port.write32(0x24, 0x03010003);
  }

  void move(std::int64_t edges, double duration = 1e-3) {
    std::array<EncoderMotion, 4> motions{};
    motions[0].edges = edges;
    inputs.move(motions, duration);
  }

  std::int32_t counter() {
    port.write32(0x28, 0x1);
    return static_cast<std::int32_t>(port.read32(0x00));
  }

  std::unique_ptr<BoardRegisters> boards = std::make_unique<BoardRegisters>();
  Pci1784Registers& card = boards->pci1784;
  EmulatedPci1784 port{card};
  QuadratureInputs inputs{card};
};

TEST_F(Quadrature, FourfoldCountsEveryEdgeBothWays) {
  move(7);
  EXPECT_EQ(counter(), 7);
  move(-10);
  EXPECT_EQ(counter(), -3);
}

TEST_F(Quadrature, TwofoldAndSimpleCountHalfAndAQuarterOfTheEdges) {
  for (const auto& [mode, share] : {std::pair{0x192U, 2}, std::pair{0x191U, 4}}) {
    port.write32(0x00, mode);
    port.write32(0x2C, 0x1);
    for (int i = 0; i < 1000; ++i) {
      move(1);
    }
    EXPECT_EQ(counter(), 1000 / share);
    for (int i = 0; i < 1000; ++i) {
      move(-1);
    }
    EXPECT_EQ(counter(), 0) << "there and back leaves nothing";
  }
}

TEST_F(Quadrature, ModesThatDoNotCountStandStill) {
  port.write32(0x00, 0x190);
  move(100);
  EXPECT_EQ(counter(), 0);
}

// Largest frequency of phase A at filter clocks of 8, 4, 2, 1 MHz; four edges a pulse.
TEST_F(Quadrature, TheFilterPassesItsFrequencyAndNoMore) {
  const std::array<double, 4> megahertz{2.0, 1.0, 0.5, 0.25};
  for (std::uint32_t clock = 0; clock < 4; ++clock) {
    port.write32(0x24, clock << 24 | 0x00010003);
    port.write32(0x2C, 0x1);
    const double duration = 10e-3;
    const auto most = static_cast<std::int64_t>(megahertz[clock] * 1e6 * duration * 4.0);
    const std::uint64_t lost = inputs.lost_edges();
    move(most, duration);
    EXPECT_EQ(counter(), most);
    move(-most, duration);
    EXPECT_EQ(counter(), 0);
    EXPECT_EQ(inputs.lost_edges(), lost);
    move(most + 1000, duration);
    EXPECT_EQ(counter(), most);
    EXPECT_EQ(inputs.lost_edges(), lost + 1000);
  }
}

TEST_F(Quadrature, PassingTheEndsOfTheCounterIsReported) {
  move(-1);
  EXPECT_EQ(port.read32(0x20) & 0x11, 0x10U) << "underflow";
  port.read32(0x24);
  move(2);
  EXPECT_EQ(port.read32(0x20) & 0x11, 0x01U) << "overflow";
  EXPECT_EQ(counter(), 1);
}

TEST_F(Quadrature, PassingTheCompareValueIsReported) {
  port.write32(0x10, 100);
  port.read32(0x24);
  move(100);
  EXPECT_EQ(port.read32(0x20) & 0x00110000, 0U);
  move(1);
  EXPECT_EQ(port.read32(0x20) & 0x00110000, 0x00010000U) << "over";
  port.read32(0x24);
  move(-1);
  EXPECT_EQ(port.read32(0x20) & 0x00110000, 0U);
  move(-1);
  EXPECT_EQ(port.read32(0x20) & 0x00110000, 0x00100000U) << "under";
}

TEST_F(Quadrature, TheIndexResetsWhereItIsEnabled) {
  std::array<EncoderMotion, 4> motions{};
  motions[0] = {500, true, 120};
  inputs.move(motions, 1e-3);
  EXPECT_EQ(counter(), 500);
  EXPECT_NE(port.read32(0x20) & 1U << 8, 0U);
  port.write32(0x2C, 0x10);
  inputs.move(motions, 1e-3);
  EXPECT_EQ(counter(), 120) << "0 at the index, and on from there";
}

}  // namespace quadrature_inputs_test
}  // namespace twin::hal::rig::boards

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "program.hpp"

namespace twin::gcode {
namespace threading_test {

using testing::HasSubstr;

TEST(Threading, GoesALeadATurnOfTheSpindle) {
  const auto blocks = blocks_of("S300 M3\nG33 Z-5 K1.5\nX1 K2\nG20 G33 X2 K0.05\nG1 X3 F100");
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].motion, Motion::kLinear);
  EXPECT_DOUBLE_EQ(blocks[0].feedrate, 7.5);
  EXPECT_DOUBLE_EQ(blocks[1].feedrate, 10.0);
  EXPECT_DOUBLE_EQ(blocks[2].feedrate, 0.05 * 25.4 * 5.0);
  EXPECT_DOUBLE_EQ(blocks[3].feedrate, 100.0 * 25.4 / 60.0);
}

TEST(Threading, RigidTappingGoesThereAndBack) {
  const auto blocks = blocks_of("S600 M3\nG0 X1 Y2\nG33.1 Z-5 K1 I2\nG91 G1 X1 F60");
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[1].end, Vec3(1.0, 2.0, -5.0));
  EXPECT_DOUBLE_EQ(blocks[1].feedrate, 10.0);
  EXPECT_EQ(blocks[2].end, Vec3(1.0, 2.0, 0.0));
  EXPECT_DOUBLE_EQ(blocks[2].feedrate, 20.0);
  EXPECT_EQ(blocks[3].end, Vec3(2.0, 2.0, 0.0));
}

TEST(Threading, IsNotedAsNotCoupled) {
  Reader reader = Reader::from_text("S100 M3\nG33 Z-5 K1\nZ-6 K1\n", "p.nc");
  ASSERT_TRUE(read_rest(reader));
  ASSERT_EQ(reader.notes().all().size(), 1U);
  EXPECT_THAT(reader.notes().all().front().text, HasSubstr("the spindle is not coupled"));
  EXPECT_EQ(reader.notes().all().front().count, 2);
}

TEST(Threading, NeedsLeadSpeedAndPlace) {
  EXPECT_EQ(error_of("S100\nG33 Z-1"),
            "line 2:1: G33 has no lead: expected K on its line, the way "
            "of one turn of the spindle");
  EXPECT_EQ(error_of("G33 Z-1 K1"),
            "line 1:1: G33 has no spindle speed: expected an S word before "
            "it, for its feedrate is K times S");
  EXPECT_THAT(error_of("S100 G33 K1"), HasSubstr("G33 leads nowhere"));
  EXPECT_THAT(error_of("S100 G33 Z-1 K0"), HasSubstr("line 1:14: K0 of G33: expected"));
  EXPECT_THAT(error_of("S100 G33 Z-1 K1 F5"), HasSubstr("line 1:17: F beside G33"));
  EXPECT_THAT(error_of("S100 G96 G33 Z-1 K1"), HasSubstr("expected G97"));
  EXPECT_THAT(error_of("S100 G33.1 Z-1 K1 I0"), HasSubstr("I0 of G33.1"));
  EXPECT_THAT(error_of("S100 G41.1 D1\nG33 X9 K1"), HasSubstr("expected G40 before it"));
}

TEST(Threading, AFeedrateInPlaceOfTheProgramsHoldsForThreadsToo) {
  ReaderOptions options;
  options.feedrate = 3.0;
  EXPECT_EQ(blocks_of("G33 Z-1 K1", options).front().feedrate, 3.0);
}

/// A thread outside of X10, 8 mm long: crest 1 mm below the drive line, 0.6 mm deep.
constexpr const char* kThread = "S60 M3\nG0 X10 Z2\nG76 P1.5 Z-6 I-1 J0.2 K0.6";

TEST(ThreadingCycle, TakesPassesOfTheSameDepth) {
  const auto blocks = blocks_of(kThread);
  // Three passes of four moves behind the approach; the last ends on the drive line.
  ASSERT_EQ(blocks.size(), 1U + 3U * 4U);
  for (std::size_t pass = 0; pass < 3; ++pass) {
    const double depth = 1.0 + 0.2 * static_cast<double>(pass + 1);
    const Block& clear = blocks[1 + 4 * pass];
    const Block& in = blocks[2 + 4 * pass];
    const Block& cut = blocks[3 + 4 * pass];
    EXPECT_NEAR(clear.end.x(), 10.0 - depth + 1.6, 1e-12);
    EXPECT_NEAR(in.end.x(), 10.0 - depth, 1e-12);
    EXPECT_EQ(in.motion, Motion::kRapid);
    EXPECT_EQ(cut.motion, Motion::kLinear);
    EXPECT_DOUBLE_EQ(cut.feedrate, 1.5);
    EXPECT_EQ(cut.start.z(), 2.0);
    EXPECT_EQ(cut.end.z(), -6.0);
  }
  EXPECT_NEAR(blocks.back().end.x(), 10.0, 1e-12);
}

TEST(ThreadingCycle, DegressionMakesEveryPassCutTheSameArea) {
  // With R2 the depths below the crest are J sqrt(n), whose squares are n J^2.
  const auto blocks = blocks_of(std::string(kThread) + " R2");
  std::vector<double> squares;
  for (const Block& block : blocks) {
    if (block.motion == Motion::kLinear) {
      squares.push_back(std::pow(9.0 - block.end.x(), 2.0));
    }
  }
  ASSERT_EQ(squares.size(), 9U);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    EXPECT_NEAR(squares[i], 0.04 * static_cast<double>(i + 1), 1e-12);
  }
}

TEST(ThreadingCycle, CompoundSlideCutsAlongTheFlank) {
  const auto blocks = blocks_of(std::string(kThread) + " Q30");
  std::vector<Vec3> starts;
  for (const Block& block : blocks) {
    if (block.motion == Motion::kLinear) {
      starts.push_back(block.start);
      EXPECT_NEAR(block.start.z() - block.end.z(), 8.0 - 0.6 * std::tan(M_PI / 6.0), 1e-12);
    }
  }
  ASSERT_EQ(starts.size(), 3U);
  EXPECT_NEAR((starts[2].z() - starts[0].z()) / (starts[2].x() - starts[0].x()),
              std::tan(M_PI / 6.0), 1e-12);
}

TEST(ThreadingCycle, TapersKeepTheRateAlongTheThread) {
  for (const Block& block : blocks_of(std::string(kThread) + " E0.8 L3 H1")) {
    const Vec3 way = block.end - block.start;
    if (block.motion == Motion::kLinear && way.z() != 0.0) {
      EXPECT_NEAR(std::abs(way.z()) / way.norm() * block.feedrate, 1.5, 1e-9);
    }
  }
}

TEST(ThreadingCycle, NeedsItsWords) {
  EXPECT_THAT(error_of("S60\nG76 Z-6 I-1 J0.2 K0.6"), HasSubstr("G76 has no lead: expected P"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 J0.2 K0.6"), HasSubstr("G76 (threading) has no I"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I0 J0.2 K0.6"), HasSubstr("line 2:12: I0 of G76"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I-1 J0 K0.6"), HasSubstr("J0 of G76"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I-1 J1 K0.6"), HasSubstr("K0.6 of G76"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I-1 J.1 K1 Q90"), HasSubstr("Q90 of G76"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I-1 J.1 K1 L4"), HasSubstr("L4 of G76"));
  EXPECT_THAT(error_of("S60\nG76 P1 Z-6 I-1 J.00001 K1"), HasSubstr("at most 10000 passes"));
  ReaderOptions options;
  options.dialect = Dialect::kFanuc;
  EXPECT_THAT(error_of("S60\nG76 X1 Z-6 R1 Q0.1 P100", options), HasSubstr("G76 (fine boring)"));
}

}  // namespace threading_test
}  // namespace twin::gcode

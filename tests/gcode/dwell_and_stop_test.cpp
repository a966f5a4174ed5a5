#include <gtest/gtest.h>

#include "program.hpp"

namespace twin::gcode {
namespace dwell_and_stop_test {

TEST(Dwell, TakesItsTimeInSecondsWhereThePathStands) {
  const auto blocks = blocks_of("G0 X1 Y2\nG4 P0.25\nX3");
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[1].motion, Motion::kDwell);
  EXPECT_EQ(blocks[1].dwell, 0.25);
  EXPECT_EQ(blocks[1].start, Vec3(1.0, 2.0, 0.0));
  EXPECT_EQ(blocks[1].end, blocks[1].start);
  EXPECT_EQ(blocks[1].feedrate, 0.0);
  EXPECT_EQ(blocks[2].start, blocks[1].end);
  EXPECT_EQ(blocks[2].dwell, 0.0);
}

TEST(Dwell, TimeIsNotALengthInInches) { EXPECT_EQ(blocks_of("G20 G0 X1\nG4 P2")[1].dwell, 2.0); }

TEST(Dwell, NeedsItsTimeAndNothingElse) {
  EXPECT_EQ(error_of("G0 X1\nG4"), "line 2:1: G04 has no time: expected P, in seconds");
  EXPECT_EQ(error_of("G4 X2"), "line 1:1: G04 has no time: expected P, in seconds");
  EXPECT_EQ(error_of("G4 P1 X2"),
            "line 1:7: a move beside G04: expected P, in seconds, and no other word");
  EXPECT_EQ(error_of("G4 P-1"), "line 1:4: P-1: expected zero or more");
  EXPECT_EQ(error_of("G0 X1 P1"), "line 1:7: P needs G04 or G64 on its line");
  EXPECT_EQ(error_of("G4 G64 P1"),
            "line 1:8: P with both G04 and G64: expected them on lines of their own");
}

TEST(Stop, ToolChangeComesBeforeTheMoveAndStopAfterIt) {
  const auto blocks = blocks_of("G0 X1\nM0 X2 T2 M6\nM1 X3");
  ASSERT_EQ(blocks.size(), 5U);
  EXPECT_EQ(blocks[1].motion, Motion::kDwell);
  EXPECT_EQ(blocks[1].end.x(), 1.0);
  EXPECT_EQ(blocks[2].motion, Motion::kRapid);
  EXPECT_EQ(blocks[3].motion, Motion::kDwell);
  EXPECT_EQ(blocks[3].dwell, 0.0);
  EXPECT_EQ(blocks[3].end.x(), 2.0);
  EXPECT_EQ(blocks[4].motion, Motion::kRapid);
}

TEST(Stop, SpindleAndCoolantPassBy) {
  EXPECT_EQ(blocks_of("G0 X1\nM3 S100 M8\nM4\nM5\nM7\nM9\nX2").size(), 2U);
}

}  // namespace dwell_and_stop_test
}  // namespace twin::gcode

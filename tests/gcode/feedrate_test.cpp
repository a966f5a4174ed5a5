#include <gtest/gtest.h>

#include "program.hpp"

namespace twin::gcode {
namespace feedrate_test {

TEST(Feedrate, MillimetresPerMinuteBecomeMillimetresPerSecond) {
  EXPECT_DOUBLE_EQ(blocks_of("G1 X1 F3000")[0].feedrate, 50.0);
}

TEST(Feedrate, FeedMoveWithoutOneIsRefusedByItsName) {
  EXPECT_EQ(error_of("G0 X1\nG1 X2"),
            "line 2:4: G01 has no feedrate: expected an F word on this line or before it");
  EXPECT_EQ(error_of("G3 I1"),
            "line 1:4: G03 has no feedrate: expected an F word on this line or before it");
}

TEST(Feedrate, ZeroAndBelowAreRefused) {
  EXPECT_EQ(error_of("G1 X1 F0"),
            "line 1:7: F0: expected a feedrate above zero, in units per minute");
  EXPECT_EQ(error_of("F-10"),
            "line 1:1: F-10: expected a feedrate above zero, in units per minute");
}

TEST(Feedrate, OptionTakesThePlaceOfEveryFWord) {
  ReaderOptions options;
  options.feedrate = 7.0;
  const auto blocks = blocks_of("G1 X1\nX2 F60\nG2 X3 R5\nG0 X0", options);
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].feedrate, 7.0);
  EXPECT_EQ(blocks[1].feedrate, 7.0);
  EXPECT_EQ(blocks[2].feedrate, 7.0);
  EXPECT_EQ(blocks[3].feedrate, 0.0);
  EXPECT_EQ(error_of("G1 X1 F0", options),
            "line 1:7: F0: expected a feedrate above zero, in units per minute");
}

}  // namespace feedrate_test
}  // namespace twin::gcode

#include <gtest/gtest.h>

#include "program.hpp"

namespace twin::gcode {
namespace modal_test {

TEST(Modal, MotionAndFeedrateStayInForce) {
  const auto blocks = blocks_of("G1 F600 X1\nY1\nG0 X0\nY0\n");
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[1].motion, Motion::kLinear);
  EXPECT_EQ(blocks[1].feedrate, 10.0);
  EXPECT_EQ(blocks[3].motion, Motion::kRapid);
  EXPECT_EQ(blocks[3].feedrate, 0.0);
  EXPECT_EQ(blocks[3].line, 4);
}

TEST(Modal, StartIsTheEndOfTheBlockBefore) {
  ReaderOptions options;
  options.start = Vec3(5.0, 6.0, 7.0);
  const auto blocks = blocks_of("G0 X1\nG1 F1 Z2\n", options);
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_EQ(blocks[0].start, Vec3(5.0, 6.0, 7.0));
  EXPECT_EQ(blocks[0].end, Vec3(1.0, 6.0, 7.0));
  EXPECT_EQ(blocks[1].start, blocks[0].end);
  EXPECT_EQ(blocks[1].end, Vec3(1.0, 6.0, 2.0));
}

TEST(Modal, InchesScaleLengthsFeedrateAndToleranceOfTheirOwnLine) {
  const auto blocks = blocks_of("G1 X1 F60 G64 P0.001 G20\nG3 X3 I1\nG21 X0 Y5 R50\nG1 X1\n");
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[0].end.x(), 25.4);
  EXPECT_EQ(blocks[0].feedrate, 25.4);
  EXPECT_EQ(blocks[0].tolerance, 0.0254);
  EXPECT_NEAR(blocks[1].arc.radius, 25.4, 1e-12);
  EXPECT_NEAR(blocks[2].arc.radius, 50.0, 1e-12);
  EXPECT_EQ(blocks[3].feedrate, 25.4);
  EXPECT_EQ(blocks[3].end.x(), 1.0);
}

TEST(Modal, IncrementalMovesAddUp) {
  const auto blocks = blocks_of("G0 X1 Y1\nG91 X1\nX1 Y-3\nG90 Y4\n");
  ASSERT_EQ(blocks.size(), 4U);
  EXPECT_EQ(blocks[1].end, Vec3(2.0, 1.0, 0.0));
  EXPECT_EQ(blocks[2].end, Vec3(3.0, -2.0, 0.0));
  EXPECT_EQ(blocks[3].end, Vec3(3.0, 4.0, 0.0));
}

TEST(Modal, TinyIncrementsAreNotLost) {
  std::string text = "G91 G1 F60\n";
  for (int i = 0; i < 4000; ++i) {
    text += "X0.0000000004\n";
  }
  EXPECT_NEAR(blocks_of(text + "X1").back().end.x(), 1.0000016, 1e-12);
}

TEST(Modal, PathModeAndTolerance) {
  const auto blocks =
      blocks_of("G0 X1\nG61 X2\nX3\nG61.1 X4\nG64 P0.02 X5\nX6\nG64 X7\nG64 P0 X8\n");
  ASSERT_EQ(blocks.size(), 8U);
  const PathMode modes[] = {PathMode::kContinuous, PathMode::kExactStop,  PathMode::kExactStop,
                            PathMode::kExactStop,  PathMode::kContinuous, PathMode::kContinuous,
                            PathMode::kContinuous, PathMode::kContinuous};
  const double tolerances[] = {0.0, 0.0, 0.0, 0.0, 0.02, 0.02, 0.0, 0.0};
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    EXPECT_EQ(blocks[i].path_mode, modes[i]) << i;
    EXPECT_EQ(blocks[i].tolerance, tolerances[i]) << i;
  }
}

TEST(Modal, RepeatedWordsMakeNoBlocks) {
  const std::string plain = "G1 F600 X1\n\n\nX2\nX3\n";
  const std::string repeated =
      "G1 F600 X1 S1000 M3 T1\nF600 S1000 M3\nG1 G17 G21 G40 G49 G54 G64 G90 G94\n"
      "G1 X2 F600 S1000 M3 T1 M8\nG1 X3 F600 M9 M5\n";
  EXPECT_EQ(to_text(blocks_of(repeated)), to_text(blocks_of(plain)));
}

TEST(Modal, BlocksOfNoLengthVanishButFullCirclesStay) {
  const auto blocks = blocks_of("G1 F60 X0\nX1\nX1 Y0 Z0\nG0 X1\nG2 I5\nG2 X1 J5\nG91 G1 X0\n");
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[0].line, 2);
  EXPECT_EQ(blocks[1].line, 5);
  EXPECT_EQ(blocks[2].line, 6);
}

TEST(Modal, CancelledMotionRefusesAxisWordsUntilTheNextMotionWord) {
  EXPECT_EQ(blocks_of("G0 X1\nG80\nF100 S1\nG1 X2\n").size(), 2U);
  EXPECT_EQ(error_of("G0 X1\nG80\nX2\n"),
            "line 3:1: a place to go to, but no motion in force: expected G00, G01, G02 or G03");
  EXPECT_EQ(error_of("F100 Y1"),
            "line 1:6: a place to go to, but no motion in force: expected G00, G01, G02 or G03");
}

}  // namespace modal_test
}  // namespace twin::gcode

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

namespace twin::gcode {
namespace saved_state_test {

using testing::HasSubstr;

TEST(SavedState, M72RestoresModesFeedAndOffsetsButNotTheMotion) {
  const auto blocks =
      blocks_of("G0 X1 F600\nG10 L2 P2 X100\nM70\nG20 G91 G55 F1 G1 X1\nG43.1 Z2\nM72\nX5\nZ0\n");
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_NEAR(blocks[1].end.x(), 26.4, 1e-12);
  EXPECT_EQ(blocks[2].motion, Motion::kLinear);
  EXPECT_EQ(blocks[2].feedrate, 10.0);
  EXPECT_NEAR((blocks[2].end - Vec3(5.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(SavedState, M73RestoresWhereTheSubroutineEnds) {
  const auto blocks = blocks_of("o1 sub\nM73\nG91\nG0 X1\no1 endsub\nG0 X5\no1 call\nX2\n");
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[1].end.x(), 6.0);
  EXPECT_EQ(blocks[2].end.x(), 2.0);
}

TEST(SavedState, EachCallHasItsOwn) {
  EXPECT_EQ(
      blocks_of("o1 sub\nM70\nG91\no1 endsub\nM70\no1 call\nG0 X1\nX1\nM72\nX5").back().end.x(),
      5.0);
  EXPECT_THAT(error_of("o1 sub\nM72\no1 endsub\nM70\no1 call\n"),
              HasSubstr("line 2:1: M72 restores a state that was not kept"));
}

TEST(SavedState, WhatCannotBeKeptOrRestoredIsRefused) {
  EXPECT_THAT(error_of("M72"), HasSubstr("expected M70 before it"));
  EXPECT_THAT(error_of("M70\nM71\nM72"), HasSubstr("expected M70 before it"));
  EXPECT_THAT(error_of("M70 G0"), HasSubstr("another word beside M70 to M73"));
  EXPECT_THAT(error_of("G41.1 D1\nM70"), HasSubstr("M70 to M73 with the cutter compensation on"));
}

}  // namespace saved_state_test
}  // namespace twin::gcode

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "program.hpp"

namespace twin::gcode {
namespace polar_test {

using testing::HasSubstr;

TEST(Polar, DistanceAndAngleAreFromTheOrigin) {
  const auto blocks = blocks_of("G0 X10 Y0\n@5 ^90\n^180\n@7\nG20 @1 ^0");
  ASSERT_EQ(blocks.size(), 5U);
  EXPECT_NEAR((blocks[1].end - Vec3(0.0, 5.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((blocks[2].end - Vec3(-5.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((blocks[3].end - Vec3(-7.0, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((blocks[4].end - Vec3(25.4, 0.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(Polar, WithG91BothCountFromThePlaceBefore) {
  const auto blocks = blocks_of("G0 X10 Y0\nG91 G1 @5 ^10 Z1 F100");
  const double angle = 10.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR((blocks.at(1).end - Vec3(15.0 * std::cos(angle), 15.0 * std::sin(angle), 1.0)).norm(),
              0.0, 1e-12);
}

TEST(Polar, IncrementalCycleGoesRoundTheOrigin) {
  const auto blocks = blocks_of("G0 X1.5 Y0 Z0\nG91 G81 R.1 Z-.5 ^60 L6 F10");
  int holes = 0;
  for (const Block& block : blocks) {
    if (block.motion == Motion::kLinear) {
      ++holes;
      const double angle = 60.0 * holes * std::numbers::pi / 180.0;
      EXPECT_NEAR((block.end - Vec3(1.5 * std::cos(angle), 1.5 * std::sin(angle), -0.4)).norm(),
                  0.0, 1e-9);
    }
  }
  EXPECT_EQ(holes, 6);
}

TEST(Polar, WhatHasNoMeaningIsRefused) {
  EXPECT_THAT(error_of("G0 X3 @2"), HasSubstr("line 1:7: @ or ^ beside X or Y"));
  EXPECT_THAT(error_of("G18 G0 @2 ^3"), HasSubstr("expected G17"));
  EXPECT_THAT(error_of("G92 @2 ^3"), HasSubstr("places that a move leads to"));
  EXPECT_THAT(error_of("G91 G0 @2 ^3"), HasSubstr("at the origin, which has no angle"));
  EXPECT_THAT(error_of("G0 @2 @3"), HasSubstr("@ appears twice on the line"));
  EXPECT_THAT(error_of("G0 ^"), HasSubstr("^ has no number"));
}

}  // namespace polar_test
}  // namespace twin::gcode

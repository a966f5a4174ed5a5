#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "program.hpp"

namespace twin::gcode {
namespace cutter_compensation_test {

/// Distance of a point from a segment.
double distance(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 along = to - from;
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - from - share * along).norm();
}

/// Points along a block.
std::vector<Vec3> points_of(const Block& block) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) {
    const double share = i / 20.0;
    points.push_back(block.motion == Motion::kArc
                         ? geometry::point_at(block.arc, share)
                         : Vec3(block.start + share * (block.end - block.start)));
  }
  return points;
}

TEST(CutterCompensation, StaysTheRadiusAwayFromEveryLineOfTheContour) {
  const std::vector<Vec3> contour = {{0, 0, 0},   {30, 0, 0},  {30, 20, 0}, {22, 20, 0},
                                     {22, 8, 0},  {12, 8, 0},  {8, 20, 0},  {0, 20, 0},
                                     {-9, 12, 0}, {-4, -6, 0}, {-20, -6, 0}};
  const auto blocks = blocks_of(
      "F600 G0 X-20 Y-9\nG42.1 D5 G1 X0 Y0\nX30\nY20\nX22\nY8\nX12\nX8 Y20\nX0\nX-9 Y12\nX-4 Y-6\n"
      "X-20\nG40 X-30 Y0\nM2\n");
  for (std::size_t i = 2; i + 1 < blocks.size(); ++i) {
    for (const Vec3& point : points_of(blocks[i])) {
      double least = 1e9;
      for (std::size_t k = 1; k < contour.size(); ++k) {
        least = std::min(least, distance(point, contour[k - 1], contour[k]));
      }
      EXPECT_NEAR(least, 2.5, 1e-9) << "block " << i;
    }
  }
}

TEST(CutterCompensation, BlocksJoinBitForBit) {
  const auto blocks = blocks_of("F60\nG41.1 D1 G1 X5\nG3 X9 Y4 J4\nG1 Z-1\nY9\nX0\nG40 X-5\n");
  for (std::size_t i = 1; i < blocks.size(); ++i) {
    EXPECT_EQ(blocks[i].start, blocks[i - 1].end) << i;
  }
}

TEST(CutterCompensation, TheProgramMayEndInIt) {
  const auto blocks = blocks_of("F60\nG41.1 D2 G1 X5\nX9\n");
  ASSERT_EQ(blocks.size(), 2U);
  EXPECT_NEAR((blocks[1].end - Vec3(9.0, 1.0, 0.0)).norm(), 0.0, 1e-12);
}

TEST(CutterCompensation, WhatItDoesNotGoWith) {
  const auto error_behind = [](const std::string& line) {
    return error_of("F60\nG41.1 D1 G1 X10\nX20\n" + line + "\nX30\nM2\n");
  };
  EXPECT_THAT(error_behind("G41.1 D2"),
              testing::HasSubstr("line 4:1: the cutter compensation is on"));
  EXPECT_THAT(error_behind("G18"), testing::HasSubstr("line 4:1: another plane or tool"));
  EXPECT_THAT(error_behind("T1 M6"), testing::HasSubstr("line 4:4: another plane or tool"));
  EXPECT_THAT(error_behind("G43.1 Z1"), testing::HasSubstr("line 4:1: a change of coordinates"));
  EXPECT_THAT(error_behind("G28"), testing::HasSubstr("line 4:1: a change of coordinates"));
  EXPECT_THAT(error_behind("G53 X1"), testing::HasSubstr("line 4:1: G53 moves in machine"));
  EXPECT_THAT(error_behind("G81 X1 Z-1 R1"), testing::HasSubstr("line 4:1: a canned cycle with"));
  EXPECT_THAT(error_behind("G5 X1 Y1 I1 J1 P1 Q1"), testing::HasSubstr("line 4:1: G05 draws"));
  EXPECT_THAT(error_of("G19 G41 D1\nG1 Y1 F1\n"), testing::HasSubstr("plane of G19"));
}

TEST(CutterCompensation, RestsAreBounded) {
  std::string text = "F60\nG41.1 D1 G1 X10\n";
  for (int i = 0; i < 1100; ++i) {
    text += "G4 P0.1\n";
  }
  EXPECT_THAT(error_of(text + "X20\nM2\n"), testing::HasSubstr("more than 1000 moves"));
}

}  // namespace cutter_compensation_test
}  // namespace twin::gcode

#include "studies/circular/circle_program.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "gcode/reader.hpp"

namespace twin::studies::circular {
namespace circle_program_test {

std::vector<gcode::Block> blocks_of(const std::string& text) {
  gcode::Reader reader = gcode::Reader::from_text(text, "circle.nc");
  std::vector<gcode::Block> blocks;
  for (;;) {
    const auto block = reader.next();
    EXPECT_TRUE(block) << to_string(block.error());
    if (!block || !*block) {
      return blocks;
    }
    blocks.push_back(**block);
  }
}

TEST(CircleProgram, IsApproachTwoTurnsHalfATurnAndTheWayBack) {
  for (const double radius : {20.0, 7.123456, 150.0}) {
    for (const Sense sense : kSenses) {
      const auto blocks = blocks_of(circle_program(radius, 50.0, sense));
      ASSERT_EQ(blocks.size(), 5U);
      EXPECT_EQ(blocks[0].motion, gcode::Motion::kLinear);
      const double sweeps[3] = {2.0, 2.0, 1.0};  // [half turns]
      for (std::size_t i = 1; i < 4; ++i) {
        EXPECT_EQ(blocks[i].motion, gcode::Motion::kArc);
        EXPECT_NEAR(blocks[i].arc.sweep, sweeps[i - 1] * std::numbers::pi, 1e-9);
        EXPECT_NEAR(blocks[i].arc.radius, radius, 1e-6);
        EXPECT_NEAR(blocks[i].arc.centre.norm(), 0.0, 1e-9);
        EXPECT_NEAR(blocks[i].arc.e1.cross(blocks[i].arc.e2).z(), sign_of(sense), 1e-12);
        EXPECT_NEAR(blocks[i].feedrate, 50.0, 1e-9);
      }
      EXPECT_EQ(blocks[2].line, kMeasuredLine);
      EXPECT_EQ(blocks[4].end.norm(), 0.0);
    }
  }
}

TEST(CircleProgram, TurnsStartBetweenTheQuadrants) {
  const auto blocks = blocks_of(circle_program(20.0, 50.0, Sense::kCounterClockwise));
  const double angle = std::atan2(blocks[2].start.y(), blocks[2].start.x());
  EXPECT_GT(angle, 0.5);
  EXPECT_LT(angle, 1.0);
}

TEST(CircleProgram, HasPlainDecimals) {
  const std::string text = circle_program(12.5, 1.0 / 60.0, Sense::kClockwise);
  EXPECT_NE(text.find("G02 X10 Y7.5 I-10 J-7.5"), std::string::npos) << text;
  EXPECT_NE(text.find("F1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("clockwise"), std::string::npos);
}

}  // namespace circle_program_test
}  // namespace twin::studies::circular

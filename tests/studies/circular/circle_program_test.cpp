#include "studies/circular/circle_program.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <vector>

#include "gcode/reader.hpp"
#include "tests/support/temp_folder.hpp"

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

const std::string kHeader = "t_s,line,feedrate_mm_per_s,x_enc_mm,y_enc_mm,x_table_mm,y_table_mm\n";

std::string rows(int line, int count, double feedrate) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += fmt::format("{},{},{},1,2,3,{}\n", 0.001 * i, line, feedrate, i);
  }
  return text;
}

TEST(MeasuredTurn, IsTheRowsOfItsNcLine) {
  const test::TempFolder folder;
  const auto file = folder.put("trace.csv", kHeader + rows(kMeasuredLine - 1, 90, 10.0) +
                                                rows(kMeasuredLine, 70, 50.0) +
                                                rows(kMeasuredLine + 1, 30, 20.0));
  const auto turn = read_measured_turn(file);
  ASSERT_TRUE(turn) << to_string(turn.error());
  ASSERT_EQ(turn->table.size(), 70U);
  EXPECT_EQ(turn->table[69], Vec2(3.0, 69.0));
  EXPECT_EQ(turn->encoder[0], Vec2(1.0, 2.0));
  EXPECT_DOUBLE_EQ(turn->feedrate, 50.0);
}

TEST(MeasuredTurn, OfFewSetPointsIsRefusedWithWhatToDo) {
  const test::TempFolder folder;
  const auto turn =
      read_measured_turn(folder.put("trace.csv", kHeader + rows(kMeasuredLine, 59, 1)));
  ASSERT_FALSE(turn);
  EXPECT_THAT(turn.error().message, ::testing::HasSubstr("59 set points"));
  EXPECT_THAT(turn.error().message, ::testing::HasSubstr("interpolator.period_ms"));
}

TEST(MeasuredTurn, NeedsTheTableColumns) {
  const test::TempFolder folder;
  const auto turn = read_measured_turn(
      folder.put("trace.csv", "t_s,line,feedrate_mm_per_s,x_enc_mm,y_enc_mm\n0,7,1,2,3\n"));
  ASSERT_FALSE(turn);
  EXPECT_THAT(turn.error().message, ::testing::HasSubstr("x_table_mm"));
  EXPECT_FALSE(read_measured_turn(folder / "none.csv"));
}

}  // namespace circle_program_test
}  // namespace twin::studies::circular

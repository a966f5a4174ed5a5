#include "studies/circular/measured_turn.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "studies/circular/circle_program.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::studies::circular {
namespace measured_turn_test {

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

}  // namespace measured_turn_test
}  // namespace twin::studies::circular

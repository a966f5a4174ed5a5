#include "studies/linuxcnc/controllers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace twin::studies::linuxcnc {
namespace controllers_test {

using ::testing::HasSubstr;

TEST(WithTolerance, GivesBareG64WordsAndBeginsWithThem) {
  EXPECT_EQ(with_tolerance("%\nG21 G64 G90\nG01 X1 F600\n%\n", 0.01, 0.0),
            "%\nG64 P0.01 Q0\nG21 G64 P0.01 Q0 G90\nG01 X1 F600\n%\n");
  EXPECT_EQ(with_tolerance("g64\nM30", 0.01, 0.01), "G64 P0.01 Q0.01\nG64 P0.01 Q0.01\nM30\n");
}

TEST(WithTolerance, LeavesOthersAsTheyAre) {
  const std::string text = "(G64)\nG64 P0.05\nG64.1\nG640\n;G64\nG61\n";
  EXPECT_EQ(with_tolerance(text, 0.01, 0.0), "G64 P0.01 Q0\n" + text);
}

TEST(ControllersTable, ShowsWhoKeepsTheToleranceAndWhyARunIsMissing) {
  ProgramRow row;
  row.program = "part";
  results::Summary sound;
  sound.run = results::MachineResults{};
  sound.run->machining_time = 1.25;
  sound.run->contour_error = {.max = 0.0175, .rms = 0.00519};
  sound.command_contour_error.max = 0.0099;
  sound.audit.axis[1].jerk = 50000.0;
  row.summary[0] = sound;
  sound.command_contour_error.max = 0.0963;
  row.summary[1] = sound;
  row.why_not[2] = "the machine is off";
  const TextTable table = table_of({row}, 0.01);
  ASSERT_EQ(table.lines.size(), 3U);
  EXPECT_EQ(table.lines[0].cells[0].text, "1.250");
  EXPECT_EQ(table.lines[0].cells.back().text, "yes");
  EXPECT_EQ(table.lines[1].cells.back().text, "no");
  EXPECT_EQ(table.lines[2].note, "the machine is off");
  EXPECT_THAT(to_text(table, {.notes = Notes::kShown}), HasSubstr("50000"));
  EXPECT_THAT(to_text(table, {.notes = Notes::kShown}), HasSubstr("the machine is off"));
}

}  // namespace controllers_test
}  // namespace twin::studies::linuxcnc

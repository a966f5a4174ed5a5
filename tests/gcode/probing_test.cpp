#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.hpp"

namespace twin::gcode {
namespace probing_test {

using testing::HasSubstr;

/// Where the last block of a program ends.
Vec3 end_of(const std::string& text, Dialect dialect = Dialect::kLinuxCnc) {
  ReaderOptions options;
  options.dialect = dialect;
  const auto blocks = blocks_of(text, options);
  return blocks.empty() ? Vec3(Vec3::Zero()) : blocks.back().end;
}

TEST(Probing, GoesItsWholeWayAsAFeedMove) {
  for (const std::string word : {"G38.2", "G38.3", "G38.4", "G38.5", "G31", "G31.1"}) {
    const auto blocks = blocks_of("G0 Z5\n" + word + " Z-3 F120");
    ASSERT_EQ(blocks.size(), 2U) << word;
    EXPECT_EQ(blocks[1].motion, Motion::kLinear);
    EXPECT_EQ(blocks[1].end, Vec3(0.0, 0.0, -3.0));
    EXPECT_EQ(blocks[1].feedrate, 2.0);
  }
}

TEST(Probing, IsNotedByItsOwnKind) {
  Reader reader = Reader::from_text("F100\nG38.2 Z-1\nX2\nG1 X3\n", "p.nc");
  ASSERT_TRUE(read_rest(reader));
  ASSERT_EQ(reader.notes().all().size(), 1U);
  const Note& note = reader.notes().all().front();
  EXPECT_EQ(name_of(note.kind), "probing");
  EXPECT_EQ(note.text, "there is no probe: the move goes its whole way");
  EXPECT_EQ(note.count, 2);  // G38.2 stays in force
  EXPECT_EQ(note.first_line, 2);
}

TEST(Probing, LeavesItsEndInTheParametersInCoordinatesAndUnitsOfTheProgram) {
  const Vec3 end = end_of("G20 F10\nG92 X1\nG38.2 X3 Z-1\nG92.1 G21\nG0 X#5061 Y#5062 Z#5063");
  EXPECT_LT((end - Vec3(3.0, 0.0, -1.0)).norm(), 1e-12);
}

TEST(Probing, HasNotTripped) {
  EXPECT_EQ(end_of("F10\n#5070 = 7\nG0 X#5070\nG38.3 Z-1\nG0 X[#5070 + 1]"), Vec3(1.0, 0.0, -1.0));
}

TEST(Probing, OfMachIsInItsOwnParametersToo) {
  const std::string text = "F10\nG31 Z-4\n#1 = #2002\n#2 = #5063\nG0 X#1 Y#2";
  EXPECT_EQ(end_of(text), Vec3(-4.0, -4.0, -4.0));
  EXPECT_EQ(end_of(text, Dialect::kFanuc), Vec3(0.0, -4.0, -4.0));
}

TEST(Probing, ByG31IsInForceOnItsOwnLineOnly) {
  EXPECT_EQ(error_of("F10\nG1 X1\nG31 Z-4\nX2"),
            "line 4:1: a place to go to, but no motion in force: expected G00, G01, G02 or G03");
  ReaderOptions options;
  options.dialect = Dialect::kFanuc;
  const auto blocks = blocks_of("F10\nG0 X1\nG31 Z-4\nX2", options);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(blocks[1].motion, Motion::kLinear);
  EXPECT_EQ(blocks[2].motion, Motion::kRapid);
}

TEST(Probing, NeedsAPlaceAFeedrateAndNoCompensation) {
  EXPECT_EQ(error_of("G38.2 F60"), "line 1:1: G38.2 leads nowhere: expected X, Y or Z on its line");
  EXPECT_THAT(error_of("G38.2 Z-1"), HasSubstr("line 1:7: the probing move has no feedrate"));
  EXPECT_THAT(error_of("F60 G41.1 D1\nG38.2 X9"), HasSubstr("expected G40 before it"));
  EXPECT_THAT(error_of("S100 G95 F1\nG38.2 X9"), HasSubstr("expected G94"));
  EXPECT_THAT(error_of("F60 G38.2 Z-1 P1"), HasSubstr("line 1:15: P needs"));
  EXPECT_THAT(error_of("F60 G53 G38.2 Z-1"), HasSubstr("expected G00 or G01"));
}

TEST(Probing, IsRefusedWhereTheMachineWouldNotStop) {
  ReaderOptions options;
  options.may_probe = false;
  EXPECT_EQ(error_of("F60 G0 X1\nG38.2 Z-1", options),
            "line 2:1: a probing move (G31, G38) would not stop on this machine: there is no "
            "probe; expected a simulated machine");
  EXPECT_EQ(blocks_of("F60 G0 X1\nG1 Z-1", options).size(), 2U);
}

}  // namespace probing_test
}  // namespace twin::gcode

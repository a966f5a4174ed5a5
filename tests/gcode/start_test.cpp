#include "gcode/start.hpp"

#include <gtest/gtest.h>

#include "program.hpp"

namespace twin::gcode {
namespace start_test {

ReaderOptions lifting() {
  ReaderOptions options;
  options.lifts_start = true;
  return options;
}

double height_of(const std::string& text) {
  return start_of(ProgramText::from_text(text, "p.nc"), lifting()).z();
}

TEST(Start, ProgramThatBeginsWithARapidAcrossStartsAtTheHeightOfItsRapids) {
  EXPECT_EQ(height_of("G0 X10 Y5\nZ4\nG1 Z-1 F100\n"), 4.0);
  EXPECT_EQ(height_of("G0 X10 Y5 Z4\nG1 Z-1 F100\n"), 4.0);
  EXPECT_EQ(height_of("G20\nT1 M6\nG0 X1\nG43 Z1 H1\nG1 Z-1 F100\n"), 25.4);
}

TEST(Start, OthersStartAtHeightZero) {
  EXPECT_EQ(height_of("G0 Z5\nX10\n"), 0.0);                  // its first move is no cut
  EXPECT_EQ(height_of("G0 X10\nG1 X20 F100\nG0 Z5\n"), 0.0);  // nothing says it is lifted
  EXPECT_EQ(height_of("G1 X10 F100\nG0 Z5\n"), 0.0);          // it begins with a cut
  EXPECT_EQ(height_of("G0 X10\nZ-1\nG0 Z5\n"), 0.0);
  EXPECT_EQ(height_of(""), 0.0);
  EXPECT_EQ(height_of("G0 X1 Q\n"), 0.0);
}

TEST(Start, PlaceOfTheOptionsCountsFirst) {
  ReaderOptions options = lifting();
  options.start = Vec3(1.0, 2.0, 3.0);
  const ProgramText text = ProgramText::from_text("G0 X10 Y5\nZ4\n", "p.nc");
  EXPECT_EQ(start_of(text, options), options.start);
  options.start.z() = 0.0;
  EXPECT_EQ(start_of(text, options), Vec3(1.0, 2.0, 4.0));
  options.lifts_start = false;
  EXPECT_EQ(start_of(text, options), Vec3(1.0, 2.0, 0.0));
}

TEST(Start, ReadingBeginsThere) {
  const auto blocks = blocks_of("G0 X10\nZ4\nG1 Z-1 F100\n", lifting());
  ASSERT_EQ(blocks.size(), 2U);  // nothing is left of the rapid to Z4
  EXPECT_EQ(blocks[0].start, Vec3(0.0, 0.0, 4.0));
  EXPECT_EQ(blocks[0].end, Vec3(10.0, 0.0, 4.0));
}

}  // namespace start_test
}  // namespace twin::gcode

#include <gtest/gtest.h>

#include <string>
#include <type_traits>

#include "program.hpp"

namespace twin::gcode {
namespace program_ends_test {

TEST(ProgramEnd, NothingIsReadAfterM2OrM30) {
  EXPECT_EQ(blocks_of("G0 X1\nX2 M30\n\x01 junk").size(), 2U);
  EXPECT_EQ(blocks_of("G0 X1\nM2\nX2").size(), 1U);
}

TEST(ProgramEnd, EndOfFileWillDo) {
  EXPECT_EQ(blocks_of("G0 X1").size(), 1U);
  EXPECT_EQ(blocks_of("G0 X1\n").size(), 1U);
}

TEST(ProgramEnd, SecondPercentEnds) {
  EXPECT_EQ(blocks_of("\n  \n%\nG0 X1\n%\nX2 junk").size(), 1U);
  EXPECT_EQ(blocks_of("% (name) ; more\nG0 X1\n").size(), 1U);
}

TEST(ProgramEnd, PercentBelongsBeforeTheProgram) {
  EXPECT_EQ(
      error_of("G0 X1\n%\nX2"),
      "line 2:1: % after the program has begun: expected it before every other line, or behind "
      "all of them");
  EXPECT_EQ(error_of("%G0 X1\n"), "line 1:2: words after %: expected them on the next line");
  EXPECT_EQ(error_of("%PROG\n"), "line 1:2: words after %: expected them on the next line");
  EXPECT_EQ(error_of("G0 X1 %\n"), "line 1:7: '%' must be the first character of its line");
}

TEST(ProgramEnd, PercentBehindAllLinesEnds) {
  EXPECT_EQ(blocks_of("G0 X1\n%\n \n").size(), 1U);
  EXPECT_EQ(blocks_of("(name)\n; more\n%\nG0 X1\n%\nX2").size(), 1U);
}

TEST(ProgramEnd, ProgramsThatDoNotMoveAreRefused) {
  const std::string still = "the program holds no motion: expected at least one move by G00 to G03";
  EXPECT_EQ(error_of(""), "the file is empty: expected an NC program");
  EXPECT_EQ(error_of("\xEF\xBB\xBF"), "the file is empty: expected an NC program");
  EXPECT_EQ(error_of("\n\n"), still);
  EXPECT_EQ(error_of("(nothing)\nG21\nM30\nG0 X1"), still);
  EXPECT_EQ(error_of("G0 X0 Y0\nG4 P1\nM6"), still);
}

TEST(ProgramEnd, EveryCallAfterTheEndSaysSo) {
  Reader reader = Reader::from_text("G0 X1", "p.nc");
  EXPECT_TRUE(reader.next()->has_value());
  EXPECT_FALSE(reader.next()->has_value());
  EXPECT_FALSE(reader.next()->has_value());
}

TEST(ProgramEnd, EveryCallAfterAnErrorReturnsIt) {
  Reader reader = Reader::from_text("G0 X1\nG0 X\nG0 X2", "p.nc");
  EXPECT_TRUE(reader.next().has_value());
  for (int i = 0; i < 3; ++i) {
    const auto block = reader.next();
    ASSERT_FALSE(block.has_value());
    EXPECT_EQ(to_string(block.error()),
              "p.nc:2:4: X has no number: expected one before the end of the line");
    EXPECT_EQ(exit_status(block.error()), 1);
  }
}

TEST(ProgramEnd, ErrorComesBeforeTheBlocksOfItsOwnLine) {
  EXPECT_EQ(error_of("M6 G1 X1"),
            "line 1:7: G01 has no feedrate: expected an F word on this line or before it");
}

TEST(ControlCharacters, OfATransferAreLeftOutBeforeALinesWords) {
  const std::string nul(3, '\0');
  EXPECT_EQ(blocks_of("\x01G0 X1\n\x11X2\r\n\x1A").size(), 2U);
  EXPECT_EQ(blocks_of("\x02%\nG0 X1\n%\n" + nul + "\n").size(), 1U);
  EXPECT_EQ(error_of(nul + "G0 X1"), "line 1:1: byte 0x00 is not NC text: is this an NC program?");
  EXPECT_EQ(error_of("\x02 G0 X1\nX2\x02"),
            "line 2:3: byte 0x02 is not NC text: is this an NC program?");
  EXPECT_EQ(blocks_of("\x11o1 repeat [2]\nG91 G0 X1\n\x13o1 endrepeat\nX1").size(), 3U);
  EXPECT_EQ(error_of("\x02 G0 J"),
            "line 1:6: J has no number: expected one before the end of the line");
}

TEST(BlockDelete, SkipsTheLineUnlessSwitchedOff) {
  const std::string text = "G0 X1\n /X2 junk\nX3";
  EXPECT_EQ(blocks_of(text).size(), 2U);
  ReaderOptions options;
  options.block_delete = false;
  EXPECT_EQ(blocks_of("G0 X1\n/ X2\nX3", options).size(), 3U);
  EXPECT_EQ(error_of(text, options), "line 2:6: J has no number: expected one, found 'unk'");
}

TEST(BlockDelete, SlashElsewhereIsRefused) {
  EXPECT_EQ(error_of("G0 X1 /Y2"),
            "line 1:7: '/' (block delete) must be the first character of its line");
}

TEST(Reader, MovesOnlyAndKeepsItsPlaceWhenMoved) {
  static_assert(!std::is_copy_constructible_v<Reader>);
  static_assert(std::is_move_constructible_v<Reader>);
  Reader first = Reader::from_text("G0 X1\nX2\nX3", "p.nc");
  EXPECT_EQ(first.next()->value().end.x(), 1.0);
  Reader second = std::move(first);
  EXPECT_EQ(second.next()->value().end.x(), 2.0);
  EXPECT_EQ(second.line(), 2);
  EXPECT_EQ(second.next()->value().end.x(), 3.0);
  EXPECT_EQ(second.bytes_read(), second.size());
}

}  // namespace program_ends_test
}  // namespace twin::gcode

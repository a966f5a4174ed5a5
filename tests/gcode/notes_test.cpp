#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "program.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::gcode {
namespace notes_test {

/// The notes of a program as "kind: text xCOUNT @LINE", one a line.
std::string notes_of(const std::string& text, const ReaderOptions& options = {}) {
  Reader reader = Reader::from_text(text, "", options);
  const auto blocks = read_rest(reader);
  EXPECT_TRUE(blocks) << (blocks ? "" : to_string(blocks.error()));
  std::string notes;
  for (const Note& note : reader.notes().all()) {
    notes +=
        fmt::format("{}: {} x{} @{}\n", name_of(note.kind), note.text, note.count, note.first_line);
  }
  return notes;
}

TEST(Notes, CommentsLeftOpenAndMessages) {
  EXPECT_EQ(notes_of("G0 X1 (open\nX2 (open\n(MSG, turn (the) part)"),
            "text: a comment without its ) goes to the end of its line x2 @1\n"
            "text: a comment within a comment ends with the outer one x1 @3\n"
            "message: turn (the) part x1 @3\n");
}

TEST(Notes, DwellsByTheirDialect) {
  const std::string dwell = "G0 X1\nG4 P500\n";
  EXPECT_EQ(blocks_of(dwell)[1].dwell, 500.0);
  EXPECT_EQ(blocks_of("O1\n" + dwell + "M30")[1].dwell, 0.5);
  EXPECT_EQ(blocks_of("O1\nG0 X1\nG4 P0.5\nG4 X1.5\nM30")[2].dwell, 1.5);
  ReaderOptions options;
  options.dialect = Dialect::kLinuxCnc;
  EXPECT_EQ(blocks_of("O1\n" + dwell + "M30", options)[1].dwell, 500.0);
  EXPECT_EQ(notes_of(dwell),
            "long_dwell: G04 rests for 500 s, more than a minute: with --dialect fanuc P is "
            "milliseconds x1 @2\n");
  EXPECT_EQ(notes_of("O1\n" + dwell + "M30"),
            "dialect: read as FANUC's dialect for its O1; --dialect says otherwise x1 @1\n"
            "dialect: P of G04 without a decimal point is read as milliseconds x1 @3\n");
}

TEST(Notes, FeedratesAboveTheLimitAndMissingOnes) {
  ReaderOptions options;
  options.largest_feedrate = 10.0;
  options.default_feedrate = 5.0;
  EXPECT_EQ(notes_of("G1 X1\nX2\nF6000 X3\nX4\n", options),
            "feedrate: no F yet: 300 mm/min of program.default_feedrate hold x2 @1\n"
            "feedrate: F is above the machine's 600 mm/min, which hold x1 @3\n");
  EXPECT_EQ(blocks_of("G1 X1", options)[0].feedrate, 5.0);
}

TEST(Notes, AxesThatTheUserLeavesOut) {
  ReaderOptions options;
  options.ignored_axes = "AB";
  EXPECT_EQ(notes_of("G0 X1 A90\nA10 B5\nX2", options),
            "ignored_axis: words of axis A are left out x2 @1\n"
            "ignored_axis: words of axis B are left out x1 @2\n");
}

TEST(Resume, ReadingGoesOnBehindEachFaultyLine) {
  Reader reader = Reader::from_text("G0 X1\nX\nX2\nQ1 Y]\nX3\n", "p.nc");
  std::string found;
  while (true) {
    const auto block = reader.next();
    if (!block) {
      found += fmt::format("line {} ", block.error().line);
      if (!reader.resume()) {
        break;
      }
    } else if (!*block) {
      break;
    } else {
      found += fmt::format("X{} ", (*block)->end.x());
    }
  }
  EXPECT_EQ(found, "X1 line 2 X2 line 4 X3 ");
}

TEST(Subprograms, FilesBesideTheProgramBelongToIt) {
  const test::TempFolder folder;
  folder.put("main.nc", "G0 X1\no<part> call [7]\nM98 P55\nX9\n");
  folder.put("part.ngc", "o<part> sub\nG0 X#1\nX\no<part> endsub\n");
  folder.put("55.nc", "G0 Y3\nM99\n");
  auto text = ProgramText::read(folder / "main.nc");
  ASSERT_TRUE(text);
  Reader first(*text);
  const auto failed = read_rest(first);
  ASSERT_FALSE(failed);
  EXPECT_EQ(to_string(failed.error()),
            (folder / "part.ngc").string() +
                ":3:1: X has no number: expected one before the end of the line");
  folder.put("part.ngc", "o<part> sub\nG0 X#1\no<part> endsub\n");
  Reader same(*text);
  EXPECT_FALSE(read_rest(same)) << "a file is read once";
  EXPECT_TRUE(text->has_changed());
  text = ProgramText::read(folder / "main.nc");
  Reader fresh(*text);
  const auto blocks = read_rest(fresh);
  ASSERT_TRUE(blocks) << to_string(blocks.error());
  EXPECT_EQ(blocks->size(), 4U);
  EXPECT_EQ((*blocks)[1].line, 2) << "the line of the call";
  EXPECT_EQ(text->subprograms().size(), 2U);
}

TEST(Subprograms, LinksMayNotLeadOutOfTheFolder) {
  const test::TempFolder folder;
  std::filesystem::create_directories(folder / "in");
  folder.put("secret.ngc", "o<part> sub\nG0 X1\no<part> endsub\n");
  folder.put("in/main.nc", "o<part> call\n");
  std::filesystem::create_symlink(folder / "secret.ngc", folder / "in/part.ngc");
  const auto text = ProgramText::read(folder / "in/main.nc");
  ASSERT_TRUE(text);
  Reader reader(*text);
  const auto blocks = read_rest(reader);
  ASSERT_FALSE(blocks);
  EXPECT_THAT(to_string(blocks.error()), testing::HasSubstr("is a link out of its folder"));
}

}  // namespace notes_test
}  // namespace twin::gcode

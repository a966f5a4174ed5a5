#include "core/text_table.hpp"

#include <gtest/gtest.h>

namespace twin {
namespace text_table_test {

TextTable sample() {
  TextTable table;
  table.title = "A table";
  table.row_head = "row";
  table.head = {"first column", "b"};
  table.lines = {
      {.row = "one", .what = "um", .cells = {{"1.5"}, {"2", Mark::kOutside}}, .note = "x"},
      {.row = "two", .what = "", .cells = {{"10.25"}, {"-", Mark::kDoubtful}}, .note = ""}};
  return table;
}

TEST(TextTable, ColumnsStandInLine) {
  EXPECT_EQ(to_text(sample()),
            "A table\n"
            "         first\n"
            "row     column      b\n"
            "one  um    1.5      2!\n"
            "two      10.25      -*\n");
}

TEST(TextTable, LayoutIndentsWidensAndShowsNotes) {
  EXPECT_EQ(
      to_text(sample(), {.indent = 2, .row_width = 6, .cell_width = 7, .notes = Notes::kShown}),
      "A table\n"
      "               first\n"
      "  row         column        b\n"
      "  one     um     1.5        2! x\n"
      "  two          10.25        -*\n");
}

TEST(TextTable, LinesWithoutCellsAreANameAndAText) {
  TextTable table;
  table.lines = {{.row = "path length", .what = "455.1 mm", .cells = {}, .note = {}}};
  EXPECT_EQ(to_text(table, {.indent = 2, .row_width = 14}), "  path length     455.1 mm\n");
}

TEST(TextTable, MarkdownHasTheSameColumnsInEveryRow) {
  EXPECT_EQ(to_markdown(sample()),
            "## A table\n\n"
            "| row | | first column | b |\n"
            "| --- | --- | ---: | ---: |\n"
            "| one | um | 1.5 | **2** |\n"
            "| two |  | 10.25 | - |\n\n");
}

TEST(TextTable, QuotesInAFieldOfCsvAreDoubled) { EXPECT_EQ(quote_csv("a\"b,c"), "\"a\"\"b,c\""); }

}  // namespace text_table_test
}  // namespace twin

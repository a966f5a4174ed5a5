#include "gcode/text/line_source.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::gcode {
namespace line_source_test {

using Lines = std::vector<std::string>;

LineSource source_of(std::string text) {
  return LineSource(ProgramText::from_text(std::move(text), "text"));
}

Lines lines_of(LineSource source) {
  Lines lines;
  for (auto line = source.next(); line && *line; line = source.next()) {
    lines.emplace_back(**line);
  }
  return lines;
}

Lines lines_of_text(const std::string& text) { return lines_of(source_of(text)); }

TEST(LineSource, AllThreeLineEndsAndAMissingLastOne) {
  EXPECT_EQ(lines_of_text("a\nb\r\nc\rd"), (Lines{"a", "b", "c", "d"}));
  EXPECT_EQ(lines_of_text("a\n"), (Lines{"a"}));
  EXPECT_EQ(lines_of_text("a\r"), (Lines{"a"}));
  EXPECT_EQ(lines_of_text("\n\r\n\r\r"), (Lines{"", "", "", ""}));
  EXPECT_EQ(lines_of_text(""), Lines{});
}

TEST(LineSource, ByteOrderMarkIsSkippedAtTheStartOnly) {
  EXPECT_EQ(lines_of_text("\xEF\xBB\xBFG1\n\xEF\xBB\xBFG2"), (Lines{"G1", "\xEF\xBB\xBFG2"}));
  EXPECT_EQ(lines_of_text("\xEF\xBB\xBF"), Lines{});
}

TEST(LineSource, LongestLineIsReadAndOneMoreCharacterIsRefused) {
  const std::string longest(LineSource::kLongestLine, ' ');
  for (const char* end : {"", "\n", "\r\n", "\r"}) {
    EXPECT_EQ(lines_of_text(longest + end).size(), 1U);
    auto source = source_of("first\n " + longest + end);
    EXPECT_TRUE(source.next().has_value());
    const auto refused = source.next();
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().column, 4097);
    EXPECT_EQ(source.line(), 2);
  }
}

TEST(LineSource, FileGivesTheLinesOfTheSameTextAcrossItsBuffer) {
  std::mt19937_64 random(2);
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string text;
    Lines expected;
    while (text.size() < 300000) {
      expected.emplace_back(random() % 4000, static_cast<char>('a' + random() % 26));
      text += expected.back() + end;
    }
    const test::TempFolder folder;
    LineSource source(test::text_of(folder.put("text", text)));
    EXPECT_EQ(source.size(), static_cast<std::int64_t>(text.size()));
    EXPECT_EQ(lines_of(std::move(source)), expected);
  }
}

TEST(LineSource, ProgressEndsAtTheSize) {
  LineSource source = source_of("\xEF\xBB\xBFG0 X1\r\nG0 X2");
  EXPECT_EQ(source.bytes_read(), 0);
  while (*source.next()) {
  }
  EXPECT_EQ(source.bytes_read(), source.size());
  EXPECT_EQ(source.line(), 2);
}

}  // namespace line_source_test
}  // namespace twin::gcode

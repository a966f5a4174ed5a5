#include "gcode/line_source.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace twin::gcode {
namespace line_source_test {

using Lines = std::vector<std::string>;

Lines lines_of(LineSource source) {
  Lines lines;
  for (auto line = source.next(); line && *line; line = source.next()) {
    lines.emplace_back(**line);
  }
  return lines;
}

Lines lines_of_text(const std::string& text) { return lines_of(LineSource::from_text(text)); }

/// A file that goes away with the test.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content)
      : path_(std::filesystem::temp_directory_path() /
              ("line_source_test_" + std::to_string(std::random_device{}()))) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

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
    auto source = LineSource::from_text("first\n " + longest + end);
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
    const TemporaryFile file(text);
    auto source = LineSource::open(file.path());
    ASSERT_TRUE(source.has_value());
    EXPECT_EQ(source->size(), static_cast<std::int64_t>(text.size()));
    EXPECT_EQ(lines_of(std::move(*source)), expected);
  }
}

TEST(LineSource, ProgressEndsAtTheSize) {
  const TemporaryFile file("\xEF\xBB\xBFG0 X1\r\nG0 X2");
  auto source = LineSource::open(file.path());
  ASSERT_TRUE(source.has_value());
  EXPECT_EQ(source->bytes_read(), 0);
  while (*source->next()) {
  }
  EXPECT_EQ(source->bytes_read(), source->size());
  EXPECT_EQ(source->line(), 2);
}

TEST(LineSource, MissingFileAndDirectoryAreFileErrorsWithTheirName) {
  const auto missing = LineSource::open("no/such/program.nc");
  ASSERT_FALSE(missing.has_value());
  EXPECT_EQ(missing.error().code, ErrorCode::kFile);
  EXPECT_EQ(to_string(missing.error()),
            "no/such/program.nc: cannot open the NC program: No such file or directory");
  const auto folder = LineSource::open(TWIN_SOURCE_DIR);
  ASSERT_FALSE(folder.has_value());
  EXPECT_EQ(folder.error().message, "is a directory; expected an NC program");
}

}  // namespace line_source_test
}  // namespace twin::gcode

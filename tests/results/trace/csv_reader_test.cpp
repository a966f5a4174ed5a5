#include "results/trace/csv_reader.hpp"

#include <gmock/gmock.h>

#include <array>

#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::results {
namespace csv_reader_test {

using test::put;
using test::TempFolder;

/// The first error that reading columns a and b of this text gives, or "".
std::string complaint(const std::string& text) {
  const TempFolder directory;
  const auto file = directory.path() / "t.csv";
  put(file, text);
  constexpr std::array<std::string_view, 2> kWanted{"b", "a"};
  std::array<double, 2> row{};
  auto reader = CsvReader::open(file);
  Expected<bool> got = reader.map([](const CsvReader&) { return true; });
  if (reader) {
    got = reader->select(kWanted).map([] { return true; });
  }
  while (got && *got) {
    got = reader->next(row);
  }
  if (got) {
    return "";
  }
  EXPECT_EQ(got.error().code, ErrorCode::kFile);
  return to_string(got.error()).substr(file.string().size());
}

TEST(CsvReader, PicksColumnsByNameInTheOrderAskedFor) {
  const TempFolder directory;
  put(directory.path() / "t.csv", "\xEF\xBB\xBF a ,text,b\r\n1.5,word, -2e3 \r\n3,,4\r\n\r\n");
  auto reader = CsvReader::open(directory.path() / "t.csv");
  ASSERT_TRUE(reader);
  EXPECT_THAT(reader->header(), testing::ElementsAre("a", "text", "b"));
  EXPECT_TRUE(reader->has("b"));
  EXPECT_FALSE(reader->has("c"));
  constexpr std::array<std::string_view, 2> kWanted{"b", "a"};
  ASSERT_TRUE(reader->select(kWanted));
  std::array<double, 2> row{};
  ASSERT_TRUE(reader->next(row).value());
  EXPECT_THAT(row, testing::ElementsAre(-2000.0, 1.5));
  ASSERT_TRUE(reader->next(row).value());
  EXPECT_THAT(row, testing::ElementsAre(4.0, 3.0));
  EXPECT_FALSE(reader->next(row).value());
}

TEST(CsvReader, ALastLineWithoutLineEndIsARow) { EXPECT_EQ(complaint("a,b\n1,2\n3,4"), ""); }

TEST(CsvReader, ErrorsNameLineAndColumn) {
  EXPECT_EQ(complaint("a,b\n1,2\n3,x\n"), ":3:3: 'x' in column b is not a finite number");
  EXPECT_EQ(complaint("a,b\n1,nan\n"), ":2:3: 'nan' in column b is not a finite number");
  EXPECT_EQ(complaint("a,b\ninf,1\n"), ":2:1: 'inf' in column a is not a finite number");
  EXPECT_EQ(complaint("a,b\n1e999,1\n"), ":2:1: '1e999' in column a is not a finite number");
  EXPECT_EQ(complaint("a,b\n1,\n"), ":2:3: '' in column b is not a finite number");
  EXPECT_EQ(complaint("a,b\n1\n"), ":2:2: the row ends after 1 of 2 columns");
  EXPECT_EQ(complaint("a,b\n1,2\n\n3,4\n"), ":3: a blank line between rows");
}

TEST(CsvReader, AMissingColumnIsNamedWithThoseThereAre) {
  EXPECT_EQ(complaint("a,c\n1,2\n"), ":1: no column b; there are: a,c");
}

TEST(CsvReader, AnEmptyFileHasNoHeader) {
  EXPECT_EQ(complaint(""), ":1: a header line with the names of the columns is missing");
}

TEST(CsvReader, BinaryJunkIsRefused) {
  EXPECT_THAT(complaint(std::string(300000, '\0')), testing::HasSubstr(":1: a line longer than"));
  EXPECT_EQ(complaint("\x01\x02\n\x03"),
            ":1: byte 0x01 is no text; expected a header line with the names of the columns");
}

TEST(CsvReader, MissingFileAndDirectoryAreErrors) {
  EXPECT_EQ(to_string(CsvReader::open("/nonexistent.csv").error()),
            "/nonexistent.csv: cannot open: No such file or directory");
  EXPECT_EQ(to_string(CsvReader::open("/tmp").error()), "/tmp: cannot read: Is a directory");
}

TEST(CsvReader, RowsAcrossBlockBoundariesComeWhole) {
  const TempFolder directory;
  std::string text = "a,b\n";
  for (int i = 0; i < 100000; ++i) {
    text += std::to_string(i) + "," + std::to_string(i % 977) + ".5\n";
  }
  put(directory.path() / "t.csv", text);
  auto reader = CsvReader::open(directory.path() / "t.csv");
  ASSERT_TRUE(reader);
  std::array<double, 2> row{};
  for (int i = 0; i < 100000; ++i) {
    ASSERT_TRUE(reader->next(row).value());
    ASSERT_THAT(row, testing::ElementsAre(i, i % 977 + 0.5));
  }
  EXPECT_FALSE(reader->next(row).value());
  EXPECT_EQ(reader->line(), 100001);
}

}  // namespace csv_reader_test
}  // namespace twin::results

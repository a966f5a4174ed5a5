#include "studies/reproduce/published.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "studies/reproduce/published_columns.hpp"

namespace twin::studies::reproduce {
namespace published_test {

using ::testing::HasSubstr;

const PublishedRow* find(const Published& paper, int table, const std::string& interpolator,
                         double feedrate) {
  const auto found = std::ranges::find_if(paper.rows, [&](const PublishedRow& row) {
    return row.table == table && row.interpolator == interpolator &&
           row.feedrate_mm_per_min == feedrate;
  });
  return found == paper.rows.end() ? nullptr : &*found;
}

TEST(Published, Tables4And5HaveFiftySixFigures) {
  const auto paper = published();
  ASSERT_TRUE(paper) << to_string(paper.error());
  std::map<int, int> figures;
  std::map<int, int> rows;
  for (const PublishedRow& row : paper->rows) {
    figures[row.table] += static_cast<int>(row.values.size());
    ++rows[row.table];
  }
  EXPECT_EQ(figures[4] + figures[5], 56);
  EXPECT_EQ(rows, (std::map<int, int>{{1, 2}, {2, 1}, {3, 2}, {4, 4}, {5, 4}}));
  EXPECT_THAT(paper->source, HasSubstr("Wang"));
}

TEST(Published, SomeFiguresAreThoseOfThePaper) {
  const auto paper = published();
  ASSERT_TRUE(paper);
  const auto* const oxalis = find(*paper, 4, "nurbs", 2000);
  ASSERT_NE(oxalis, nullptr);
  EXPECT_EQ(oxalis->values, (std::vector<double>{19.0, 5.4, 35.7, 5.1, 51.9, 6.5, 9.509}));
  const auto* const dolphin = find(*paper, 5, "bezier", 3000);
  ASSERT_NE(dolphin, nullptr);
  EXPECT_EQ(dolphin->values, (std::vector<double>{30.0, 5.5, 68.0, 5.8, 35.5, 5.9, 9.201}));
  EXPECT_EQ(dolphin->name(), "dolphin, Fast Bezier 3,000 mm/min");
  EXPECT_EQ(find(*paper, 3, "nurbs", 3000)->values,
            (std::vector<double>{1006, 53, 18.98, 3.66, 0.66}));
}

TEST(Published, RootMeanSquareIsBelowTheMaximum) {
  const auto paper = published();
  ASSERT_TRUE(paper);
  for (const PublishedRow& row : paper->rows) {
    if (is_measured(row.table)) {
      for (std::size_t i = 0; i < 6; i += 2) {
        EXPECT_GT(row.values[i], 2.0 * row.values[i + 1]) << row.name();
      }
    }
  }
}

/// Compression is blocks before over blocks after; the paper's own figures agree with each other.
TEST(Published, CompressionFactorIsTheRatioOfTheBlocks) {
  const auto paper = published();
  ASSERT_TRUE(paper);
  for (const PublishedRow& row : paper->rows) {
    if (row.table == 3) {
      EXPECT_NEAR(row.values[0] / row.values[1], row.values[2], 0.005);
    }
  }
}

TEST(Published, NurbsRowsLandOnTheEndsOfTheirCurvesAndBezierRowsDoNot) {
  const auto paper = published();
  ASSERT_TRUE(paper);
  for (const PublishedRow& row : paper->rows) {
    const bool lands =
        std::ranges::find(row.settings, "interpolator.curve_end=land") != row.settings.end();
    EXPECT_EQ(lands, row.interpolator == "nurbs") << row.name();
  }
}

constexpr const char* kRow =
    "source = 'x'\n[[row]]\ntable = 1\nprogram = 'p'\ninterpolator = 'nurbs'\n"
    "programmed_feedrate_mm_per_min = 1000\nblocks = 5\n";

TEST(Published, MissingFigureIsNamedWithItsRow) {
  const auto paper = parse_published(std::string(kRow) + "length_mm = { max = 1.0, min = 0.5 }\n");
  ASSERT_FALSE(paper);
  EXPECT_THAT(paper.error().message, HasSubstr("length_mm.mean"));
  EXPECT_EQ(paper.error().line, 2);
}

TEST(Published, FigureThatIsNoNumberIsRefused) {
  EXPECT_FALSE(
      parse_published(std::string(kRow) + "length_mm = { max = 1.0, min = 'half', mean = 0.7 }\n"));
  EXPECT_FALSE(
      parse_published(std::string(kRow) + "length_mm = { max = inf, min = 0.5, mean = 0.7 }\n"));
  EXPECT_TRUE(
      parse_published(std::string(kRow) + "length_mm = { max = 1.0, min = 0.5, mean = 0.7 }\n"));
}

TEST(Published, RowOfNoTableIsRefused) {
  EXPECT_FALSE(parse_published("source = 'x'\n[[row]]\ntable = 6\nprogram = 'p'\n"));
  EXPECT_FALSE(parse_published("source = 'x'\n"));
  EXPECT_FALSE(parse_published("source = \n"));
}

}  // namespace published_test
}  // namespace twin::studies::reproduce

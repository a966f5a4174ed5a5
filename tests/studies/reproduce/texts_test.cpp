#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "answers.hpp"
#include "core/json.hpp"
#include "studies/reproduce/reproduction_files.hpp"

// Well-formed tables, page and files, whatever the figures.
namespace twin::studies::reproduce {
namespace texts_test {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(Texts, CsvHasALinePerFigureAndVariant) {
  const auto lines = lines_of(csv_text(test::scaled(1.1, 0.9)));
  // 2 x 4, 7 and 2 x 5 figures of Tables 1 to 3, 56 of Tables 4 and 5; two variants; the header.
  EXPECT_EQ(lines.size(), 2U * (8 + 7 + 10 + 56) + 1);
  for (const std::string& line : lines) {
    EXPECT_EQ(std::ranges::count(line, ','), 12) << line;
  }
  EXPECT_EQ(lines.back(),
            "5,dolphin,bezier,3000,defaults,time_s,s,9.201,10.1211,1.1000,8.2809,"
            "0.9201,0.9000");
}

TEST(Texts, CsvLeavesTheMeanEmptyWithoutRepeats) {
  Reproduction reproduction = test::scaled(1.1, 0.9);
  for (Variant& variant : reproduction.variants) {
    for (Answer& answer : variant.answers) {
      answer.repeats.clear();
    }
  }
  EXPECT_EQ(lines_of(csv_text(reproduction)).back(),
            "5,dolphin,bezier,3000,defaults,time_s,s,9.201,10.1211,1.1000,,,");
}

TEST(Texts, JsonHoldsCountsAndFigures) {
  const auto json = parse_json(json_text(test::scaled(1.15, 1.0)));
  EXPECT_EQ(json["counts"]["as_published"]["single"]["within_20_percent"], 56);
  EXPECT_EQ(json["counts"]["as_published"]["single"]["within_10_percent"], 0);
  EXPECT_EQ(json["counts"]["defaults"]["mean"]["within_10_percent"], 56);
  EXPECT_EQ(json["figures"].size(), 2U * (8 + 7 + 10 + 56));
}

TEST(Texts, EveryRowOfAMarkdownTableHasTheColumnsOfItsHeading) {
  std::ptrdiff_t columns = 0;
  int tables = 0;
  for (const std::string& line : lines_of(markdown_text(test::scaled(1.5, 1.0)))) {
    if (!line.starts_with('|')) {
      columns = 0;
      continue;
    }
    const auto count = std::ranges::count(line, '|');
    tables += columns == 0 ? 1 : 0;
    columns = columns == 0 ? count : columns;
    EXPECT_EQ(count, columns) << line;
  }
  EXPECT_EQ(tables, 6);  // five tables and the counts
}

TEST(Texts, RatiosMoreThan30PercentOffAreMarked) {
  EXPECT_THAT(markdown_text(test::scaled(1.5, 1.0)), HasSubstr("**1.50**"));
  EXPECT_THAT(markdown_text(test::scaled(1.2, 1.0)), Not(HasSubstr("**")));
  EXPECT_THAT(to_text(grid_of_table(test::scaled(1.5, 1.0), 4)), HasSubstr("1.50!"));
  EXPECT_THAT(to_text(grid_of_table(test::scaled(1.2, 1.0), 4)), Not(HasSubstr("!")));
  EXPECT_THAT(page_text(test::scaled(1.5, 1.0), {}), HasSubstr("class=\"out\">1.50"));
}

TEST(Texts, PageNamesItsPicturesAndEscapesText) {
  const std::string page = page_text(test::scaled(1.0, 1.0), {{"fig12_oxalis", "a < b & c"}});
  EXPECT_THAT(page, HasSubstr("src=\"figures/fig12_oxalis.png\""));
  EXPECT_THAT(page, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(page, HasSubstr("&quot;paper&quot; &amp; its tables"));
  for (const char* const tag : {"table", "tr", "ul", "figure", "div", "body", "html", "h2"}) {
    const auto count = [&](const std::string& text) {
      std::size_t n = 0;
      for (auto at = page.find(text); at != std::string::npos; at = page.find(text, at + 1)) {
        ++n;
      }
      return n;
    };
    const std::string open = std::string("<") + tag;
    EXPECT_EQ(count(open + ">") + count(open + " "), count(std::string("</") + tag + ">")) << tag;
  }
}

TEST(Texts, TerminalTableFitsAWideTerminal) {
  for (int table = 1; table <= 5; ++table) {
    for (const std::string& line :
         lines_of(to_text(grid_of_table(test::scaled(1.5, 1.0), table)))) {
      EXPECT_LE(line.size(), 110U) << line;
      EXPECT_FALSE(line.ends_with(' ')) << line;
    }
  }
}

TEST(Texts, DifferencesNameTheRowsThatAreNotReached) {
  Reproduction reproduction = test::scaled(1.0, 1.0);
  reproduction.variants[0].answers.back().repeats[4].mean *= 0.5;
  bool is_named = false;
  for (const std::string& text : differences(reproduction)) {
    is_named = is_named || text.find("dolphin, Fast Bezier 3,000 mm/min: Y max") != text.npos;
  }
  EXPECT_TRUE(is_named);
}

}  // namespace texts_test
}  // namespace twin::studies::reproduce

#include "config/nearest_name.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace twin::config {
namespace nearest_name_test {

TEST(NearestName, EditDistanceOfTextbookPairs) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("jerk", "jrek"), 1U);  // a swap is one slip
  EXPECT_EQ(edit_distance("Hz", "hZ"), 0U);
}

TEST(NearestName, IsAMetricOnShortWords) {
  const std::vector<std::string> words{"", "a", "ab", "ba", "abc", "acb", "xyz", "jerk", "period"};
  for (const auto& a : words) {
    EXPECT_EQ(edit_distance(a, a), 0U);
    for (const auto& b : words) {
      EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
      EXPECT_GE(edit_distance(a, b),
                a.size() > b.size() ? a.size() - b.size() : b.size() - a.size());
      EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
    }
  }
}

TEST(NearestName, FarWordsAreNotSuggested) {
  const std::vector<std::string> names{"acceleration", "jerk", "feedrate"};
  EXPECT_EQ(nearest_name("accelration", names), "acceleration");
  EXPECT_EQ(nearest_name("jrek", names), "jerk");
  EXPECT_EQ(nearest_name("colour", names), "");
  EXPECT_EQ(did_you_mean("feedrat", names), "; did you mean feedrate?");
  EXPECT_EQ(did_you_mean("colour", names), "");
}

}  // namespace nearest_name_test
}  // namespace twin::config

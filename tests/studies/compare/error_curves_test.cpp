#include "studies/compare/error_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/temp_folder.hpp"

namespace twin::studies::compare {
namespace error_curves_test {

TEST(Envelope, KeepsTheLargestValueOfEachStretch) {
  const results::Table table{2, {0.0, 1.0, 1.0, 5.0, 2.0, 2.0, 3.0, 7.0, 4.0, 3.0}};
  const results::Table result = running_maximum(table, 2);
  ASSERT_EQ(result.rows(), 2U);
  EXPECT_DOUBLE_EQ(result.at(0, 0), 1.0);
  EXPECT_DOUBLE_EQ(result.at(0, 1), 5.0);
  EXPECT_DOUBLE_EQ(result.at(1, 0), 3.0);
  EXPECT_DOUBLE_EQ(result.at(1, 1), 7.0);
}

TEST(Envelope, LargestOfAllStays) {
  results::Table table{2, {}};
  for (int i = 0; i < 1000; ++i) {
    table.values.push_back(0.001 * i);
    table.values.push_back(std::sin(0.37 * i) + (i == 777 ? 10.0 : 0.0));
  }
  for (const std::size_t pieces : {1U, 7U, 250U, 5000U}) {
    const results::Table result = running_maximum(table, pieces);
    EXPECT_LE(result.rows(), pieces);
    double largest = -1.0;
    for (std::size_t i = 0; i < result.rows(); ++i) {
      largest = std::max(largest, result.at(i, 1));
    }
    EXPECT_DOUBLE_EQ(largest, std::sin(0.37 * 777) + 10.0) << pieces;
  }
  EXPECT_EQ(running_maximum({2, {}}, 10).rows(), 0U);
}

/// A line at constant feedrate has no fluctuation but in the one period that is longer
/// by 1 % of its way.
TEST(Fluctuation, IsThatOfEachPeriod) {
  const test::TempFolder folder;
  std::string text = "t_s,x_cmd_mm,y_cmd_mm,z_cmd_mm,feedrate_mm_per_s\n";
  for (int i = 0; i < 100; ++i) {
    const double s = 0.05 * i + (i >= 50 ? 0.0005 : 0.0);
    text += std::to_string(0.001 * i) + "," + std::to_string(s) + ",0,0,50\n";
  }
  const auto table = read_fluctuation(folder.put("trace.csv", text), 0.001);
  ASSERT_TRUE(table) << to_string(table.error());
  ASSERT_EQ(table->rows(), 95U);
  int jumps = 0;
  for (std::size_t i = 0; i < table->rows(); ++i) {
    if (table->at(i, 1) > 0.5) {
      ++jumps;
      EXPECT_NEAR(table->at(i, 1), 1.0, 1e-6);
      EXPECT_NEAR(table->at(i, 0), 0.0495, 1e-9);
    }
  }
  EXPECT_EQ(jumps, 1);
}

TEST(Fluctuation, MissingColumnIsAnError) {
  const test::TempFolder folder;
  EXPECT_FALSE(read_fluctuation(folder.put("trace.csv", "t_s,x_cmd_mm\n0,0\n"), 0.001));
  EXPECT_FALSE(read_contour_error(folder / "none.csv"));
}

}  // namespace error_curves_test
}  // namespace twin::studies::compare

#include "pictures/plot/circular_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "results/trace/trace_reader.hpp"
#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures {
namespace circular_figure_test {

namespace fs = std::filesystem;

std::vector<Vec2> lobes(double sign, int count) {
  std::vector<Vec2> path;
  for (int i = 0; i < count; ++i) {
    const double a = sign * 2.0 * std::numbers::pi * i / count;
    const double radius = 20.0 + 0.012 * std::cos(4.0 * a);
    path.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  return path;
}

TEST(CircularFigure, DivisionIsARoundNumberThatTheLargestErrorSpansFourTimes) {
  EXPECT_DOUBLE_EQ(radial_division(0.020), 0.005);
  EXPECT_DOUBLE_EQ(radial_division(0.0201), 0.010);
  EXPECT_DOUBLE_EQ(radial_division(0.0041), 0.002);
  EXPECT_DOUBLE_EQ(radial_division(0.0039), 0.001);
  EXPECT_DOUBLE_EQ(radial_division(3.0), 1.0);
  EXPECT_NEAR(radial_division(0.0), 1e-6, 1e-18);
}

TEST(CircularFigure, HasPicturesDataAndAScriptThatSaysTheScale) {
  const test::TempFolder directory;
  const auto ccw = lobes(1.0, 3000);
  const auto cw = lobes(-1.0, 20000);
  const auto pictures = write_circular_figure(
      {directory.path(), "Circular test, 100 % o'clock", "xy_table", 20.0, {ccw, cw}});
  ASSERT_TRUE(pictures) << to_string(pictures.error());
  ASSERT_EQ(pictures->size(), 2U);
  const fs::path base = directory.path() / "plots/circular_test";
  EXPECT_GT(fs::file_size(base.string() + ".png"), 20000U);
  EXPECT_THAT(test::content(base.string() + ".svg"), ::testing::HasSubstr("</svg>"));
  EXPECT_THAT(test::content(base.string() + ".svg"), ::testing::HasSubstr("1 division = 5 µm"));
  // Nine rings, two paths, the nominal circle: gnuplot loses circles drawn as objects from an SVG.
  EXPECT_THAT(test::content(base.string() + ".svg"), ::testing::HasSubstr("gnuplot_plot_12"));
  for (const char* sense : {"_ccw.csv", "_cw.csv"}) {
    auto reader = results::TraceReader::open(base.string() + sense);
    ASSERT_TRUE(reader);
    std::array<double, 2> row{};
    double largest = 0.0;
    int rows = 0;
    while (reader->next(row).value_or(false)) {
      largest = std::max(largest, row[1]);
      ++rows;
    }
    EXPECT_NEAR(largest, 12.0, 1e-6) << "a peak was lost";
    EXPECT_LE(rows, 8000);
  }
}

}  // namespace circular_figure_test
}  // namespace twin::pictures

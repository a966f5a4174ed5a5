#include "pictures/page/page_rows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pictures/page/page.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::pictures {
namespace page_rows_test {

using ::testing::HasSubstr;

const PageColumn& column(const PageRows& rows, const std::string& name) {
  for (const PageColumn& c : rows.columns) {
    if (c.name == name) {
      return c;
    }
  }
  throw std::out_of_range(name);
}

/// A circle of 10 mm counter-clockwise at 50 mm/s, whose machine lags 3 ms and is 5 um too far out
/// in the upper half and too far in in the lower one.
std::string circle(int rows) {
  std::string text =
      "t_s,x_cmd_mm,y_cmd_mm,feedrate_mm_per_s,contour_error_um,x_tracking_error_um,"
      "y_tracking_error_um\n";
  for (int i = 0; i < rows; ++i) {
    const double t = 1e-3 * i;
    const double phi = 5.0 * t;
    const double lag = 5.0 * (t - 3e-3);
    const double r = std::sin(lag) >= 0.0 ? 10.005 : 9.995;
    const double x = 10.0 * std::cos(phi);
    const double y = 10.0 * std::sin(phi);
    text += std::to_string(t) + "," + std::to_string(x) + "," + std::to_string(y) + ",50,5," +
            std::to_string(1e3 * (x - r * std::cos(lag))) + "," +
            std::to_string(1e3 * (y - r * std::sin(lag))) + "\n";
  }
  return text;
}

class PageRowsTest : public ::testing::Test {
 protected:
  Expected<PageRows> read(const std::string& trace, std::size_t most = kMostPageRows) {
    folder.put("trace.csv", trace);
    return read_page_rows(folder / "trace.csv", folder / "limit.csv", most);
  }
  test::TempFolder folder;
};

TEST_F(PageRowsTest, ContourErrorIsPositiveLeftOfTheMotion) {
  const auto rows = read(circle(1200));
  ASSERT_TRUE(rows);
  const auto& error = column(*rows, "contour_error_signed_um").values;
  const auto& size = column(*rows, "contour_error_um").values;
  for (std::size_t i = 20; i < error.size(); ++i) {
    EXPECT_EQ(std::abs(error[i]), size[i]);
    const double lag = 5.0 * (1e-3 * static_cast<double>(i) - 3e-3);
    if (std::abs(std::sin(lag)) > 0.05) {  // outside is right of a counter-clockwise motion
      EXPECT_LT(error[i] * std::sin(lag), 0.0) << i;
    }
  }
}

TEST_F(PageRowsTest, AccelerationIsThatOfTheCircle) {
  const auto rows = read(circle(400));
  ASSERT_TRUE(rows);
  const auto& a = column(*rows, "acceleration_mm_per_s2").values;
  EXPECT_NEAR(a[200], 50.0 * 50.0 / 10.0, 5.0);  // v^2 / r; the text has six digits
}

TEST_F(PageRowsTest, LimitHoldsUntilItsNextChange) {
  folder.put("limit.csv", "t_s,feedrate_limit_mm_per_s\n0,50\n0.1,20\n0.2,80\n");
  const auto rows = read(circle(300));
  ASSERT_TRUE(rows);
  const auto& limit = column(*rows, "feedrate_limit_mm_per_s").values;
  EXPECT_EQ(limit[99], 50.0);
  EXPECT_EQ(limit[100], 20.0);
  EXPECT_EQ(limit[250], 80.0);
}

TEST_F(PageRowsTest, OfMoreRowsTheExtremesAreKept) {
  std::string text = "t_s,x_cmd_mm,y_cmd_mm,contour_error_um\n";
  for (int i = 0; i < 5000; ++i) {
    text += std::to_string(1e-3 * i) + ",0,0," + (i == 3217 ? "99.5" : "1") + "\n";
  }
  const auto rows = read(text, 500);
  ASSERT_TRUE(rows);
  EXPECT_TRUE(rows->is_thinned);
  EXPECT_EQ(rows->rows_of_trace, 5000U);
  EXPECT_LE(rows->rows(), 500U);
  EXPECT_THAT(column(*rows, "contour_error_um").values, ::testing::Contains(99.5));
  EXPECT_NEAR(rows->last_time, 4.999, 1e-9);
}

TEST_F(PageRowsTest, TimeOfALongTraceFitsIntoItsColumn) {
  const auto rows = read("t_s,x_cmd_mm,y_cmd_mm\n0,0,0\n90000,1,1\n");
  ASSERT_TRUE(rows);
  EXPECT_LT(90000.0 / column(*rows, "t_s").step, 2147483647.0);
}

TEST_F(PageRowsTest, ForeignFilesAreNamed) {
  const auto foreign = read("time,x\n1,2\n");
  ASSERT_FALSE(foreign);
  EXPECT_THAT(to_string(foreign.error()), HasSubstr("trace.csv:1: is no trace"));
  EXPECT_THAT(to_string(foreign.error()), HasSubstr("no column t_s"));
  const auto empty = read("t_s,x_cmd_mm,y_cmd_mm\n");
  ASSERT_FALSE(empty);
  EXPECT_THAT(to_string(empty.error()), HasSubstr("has no rows"));
  const auto cut = read("t_s,x_cmd_mm,y_cmd_mm\n0,0,0\n0.001,1\n");
  ASSERT_FALSE(cut);
  EXPECT_THAT(to_string(cut.error()), HasSubstr("trace.csv:3"));
}

TEST(PageText, NothingInTheDataEndsTheScript) {
  PageRun run;
  run.name = "</script><script>alert(1)</script><!--";
  run.summary = R"({"program": "</script>", "notes": ["<!-- <script>"]})";
  run.rows.columns = {
      {"t_s", 1e-6, {0.0, 0.001}}, {"x_cmd_mm", 1e-5, {0.0, 1.0}}, {"y_cmd_mm", 1e-5, {0.0, 1.0}}};
  const std::vector<PageRun> runs{run};
  const auto text = page_text(runs, "<title>");
  ASSERT_TRUE(text);
  const std::size_t data = text->find("id=\"runs\">");
  const std::size_t end = text->find("</script>", data);
  ASSERT_NE(data, std::string::npos);
  const std::string json = text->substr(data + 10, end - data - 10);
  EXPECT_TRUE(json.ends_with("]")) << json.substr(0, 300);
  EXPECT_EQ(json.find("<!"), std::string::npos);
  EXPECT_THAT(*text, HasSubstr("<title>&lt;title&gt;</title>"));
  EXPECT_THAT(*text, HasSubstr("The MIT License"));
}

}  // namespace page_rows_test
}  // namespace twin::pictures

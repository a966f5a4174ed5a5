#include "nc_programs/generate/programs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/nc_file.hpp"

namespace twin::test {
namespace short_blocks_test {

TEST(Zigzag, Has1000BlocksOfATenthAndOnlyRightAngles) {
  const std::vector<Point> p = polygon("zigzag.nc");
  ASSERT_EQ(p.size(), 1001U);
  for (std::size_t i = 1; i < p.size(); ++i) {
    EXPECT_NEAR((p[i] - p[i - 1]).norm(), 0.1, 1e-4);
  }
  for (std::size_t i = 2; i < p.size(); ++i) {
    EXPECT_NEAR((p[i] - p[i - 1]).dot(p[i - 1] - p[i - 2]), 0.0, 1.5e-5);
  }
}

TEST(Star, ItsTipsLieOnTheCircleAndItsInnerCornersOnTheDiagonals) {
  const std::vector<Point> p = polygon("star.nc");
  const auto corners = [&](double r) {
    return std::count_if(p.begin(), p.end(),
                         [&](const Point& at) { return std::abs(at.norm() - r) < 1e-3; });
  };
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  EXPECT_EQ(corners(30.0), 6);  // the first is the last
  EXPECT_EQ(corners(12.0), 6);
  EXPECT_EQ(corners(30.0 / (golden * golden)), 5);
  EXPECT_EQ(corners(12.0 / (golden * golden)), 5);
}

/// The flanks are involutes of the base circle: the normal of a flank touches that circle.
TEST(Gear, TheNormalsOfItsFlanksTouchTheBaseCircle) {
  const std::vector<Point> p = polygon("gear.nc");
  const double base = 24.0 * std::cos(20.0 * 3.14159265358979 / 180.0);
  int flanks = 0;
  for (std::size_t i = 2; i + 1 < p.size(); ++i) {
    const Point chord = p[i] - p[i - 1];
    const double r = 0.5 * (p[i] + p[i - 1]).norm();
    const bool is_on_flank = std::min(p[i].norm(), p[i - 1].norm()) > base + 0.3 &&
                             std::abs(p[i].norm() - p[i - 1].norm()) > 0.05;
    if (is_on_flank && r < 28.0) {
      ++flanks;
      EXPECT_NEAR(std::abs(chord.normalized().dot(0.5 * (p[i] + p[i - 1]))), base, 0.05);
    }
  }
  EXPECT_GT(flanks, 12 * 2 * 15);
}

TEST(Gear, NoBlockIsLongerThanAQuarterOfAMillimetreButTheWayThereAndBack) {
  std::vector<double> all = lengths(polygon("gear.nc"));
  EXPECT_LT(*std::max_element(all.begin() + 1, all.end() - 1), 0.25);
  EXPECT_GT(*std::min_element(all.begin(), all.end()), 0.1);
}

TEST(Trochoid, Has200000BlocksOfATenth) {
  const std::string text = programs::trochoid_program().text;
  EXPECT_EQ(std::count(text.begin(), text.end(), 'X'), 200000 + 1);  // and one in the comment
  EXPECT_LT(text.size(), 4'000'000U);
}

}  // namespace short_blocks_test
}  // namespace twin::test

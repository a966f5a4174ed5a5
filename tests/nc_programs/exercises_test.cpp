#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/support/nc_file.hpp"

namespace twin::test {
namespace exercises_test {

constexpr double kTravel = 190.0;  // [mm]

/// Corner angle at b [deg]; 180 is straight on.
double corner_deg(const Point& a, const Point& b, const Point& c) {
  const Point u = a - b;
  const Point v = c - b;
  return std::acos(u.normalized().dot(v.normalized())) * 180.0 / 3.14159265358979;
}

TEST(Square, HasRightAnglesAndThenEveryCornerOfTheZigzag) {
  const std::vector<Point> p = polygon("square.nc");
  ASSERT_EQ(p.size(), 19U);
  for (std::size_t i = 1; i <= 3; ++i) {
    EXPECT_NEAR(corner_deg(p[i - 1], p[i], p[i + 1]), 90.0, 1e-9);
  }
  for (std::size_t i = 6; i <= 16; ++i) {
    EXPECT_NEAR(corner_deg(p[i - 1], p[i], p[i + 1]), 165.0 - 15.0 * static_cast<double>(i - 6),
                0.01);
  }
}

/// Every arc of the file: its radius at the start and at the end, by I J where given [mm].
TEST(Arcs, EveryArcEndsOnItsCircle) {
  const std::map<std::string, int> arcs = {{"circle.nc", 12}, {"mixed.nc", 6}};
  for (const auto& [name, count] : arcs) {
    Point at = Point::Zero();
    int motion = 0;
    int found = 0;
    for (const std::string& line : code_lines(name)) {
      for (const int code : {0, 1, 2, 3}) {
        motion = line.find("G0" + std::to_string(code)) != std::string::npos ? code : motion;
      }
      const Point end(word(line, 'X', at.x()), word(line, 'Y', at.y()));
      const bool has_centre = line.find('I') != std::string::npos;
      const bool has_radius = line.find('R') != std::string::npos;
      if (motion >= 2 && (has_centre || has_radius)) {
        ++found;
        if (has_centre) {
          const Point centre = at + Point(word(line, 'I', 0.0), word(line, 'J', 0.0));
          EXPECT_DOUBLE_EQ((at - centre).norm(), (end - centre).norm()) << name << ": " << line;
        } else {
          EXPECT_LE((end - at).norm(), 2.0 * std::abs(word(line, 'R', 0.0)))
              << name << ": " << line;
        }
      }
      at = end;
    }
    EXPECT_EQ(found, count) << name;
  }
}

TEST(Mixed, SineRunHasBlocksOfAFifthOfAMillimetre) {
  Point at = Point::Zero();
  int blocks = 0;
  for (const std::string& line : code_lines("mixed.nc")) {
    const Point end(word(line, 'X', at.x()), word(line, 'Y', at.y()));
    const double length = (end - at).norm();
    if (line.front() == 'X' && length < 1.0) {
      ++blocks;
      EXPECT_NEAR(length, 0.2, 2e-4);
    }
    at = end;
  }
  EXPECT_EQ(blocks, 400);
}

TEST(EveryProgram, KeepsToTheTravelAndEndsWithM30) {
  for (const char* name : {"oxalis.nc", "dolphin.nc", "butterfly.nc", "circle.nc", "square.nc",
                           "mixed.nc", "zigzag.nc", "star.nc", "gear.nc"}) {
    const std::vector<std::string> code = code_lines(name);
    EXPECT_EQ(code.back(), "M30") << name;
    for (const std::string& line : code) {
      EXPECT_LE(std::abs(word(line, 'X', 0.0)), kTravel) << name;
      EXPECT_LE(std::abs(word(line, 'Y', 0.0)), kTravel) << name;
    }
  }
}

}  // namespace exercises_test
}  // namespace twin::test

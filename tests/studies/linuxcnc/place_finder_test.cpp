#include "studies/linuxcnc/place_finder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "gcode/reader.hpp"

namespace twin::studies::linuxcnc {
namespace place_finder_test {

PlaceFinder finder_of(const std::string& text) {
  auto reader = std::make_shared<gcode::Reader>(gcode::Reader::from_text(text, "test.nc"));
  return PlaceFinder([reader] { return reader->next(); });
}

TEST(PlaceFinder, FollowsAWayThatGoesBackAsItCame) {
  PlaceFinder places = finder_of("G01 X10 F3000\nX0\nX10\nX0\n");
  const double step = 0.05;
  int wrong = 0;
  for (int i = 0; i <= 800; ++i) {
    const double s = i * step;
    const double folded = std::abs(std::remainder(s, 20.0));
    const auto block = places.find({folded, 0.0, 0.0});
    ASSERT_TRUE(block);
    const auto expected = std::min<std::int64_t>(3, static_cast<std::int64_t>(s / 10.0));
    wrong += *block == expected ? 0 : 1;
  }
  EXPECT_LE(wrong, 3);  // at a turn, either block is right
  EXPECT_NEAR(places.place(), 40.0, 1e-9);
}

TEST(PlaceFinder, CutsCornersWithTheSetPoints) {
  PlaceFinder places = finder_of("G01 X10 F3000\nY10\n");
  for (int i = 0; i <= 95; ++i) {
    ASSERT_EQ(places.find({0.1 * i, 0.0, 0.0}).value(), 0);
  }
  ASSERT_TRUE(places.find({9.9, 0.02, 0.0}));
  ASSERT_TRUE(places.find({9.98, 0.1, 0.0}));
  EXPECT_EQ(places.find({10.0, 0.5, 0.0}).value(), 1);
  EXPECT_NEAR(places.largest_distance(), 0.02, 1e-9);
}

TEST(PlaceFinder, TellsPassesOverACrossingApart) {
  // A figure of eight: the crossing at (5, 5) is passed twice.
  PlaceFinder places = finder_of("G01 X10 Y10 F3000\nY0\nX0 Y10\n");
  const auto along = [&](Vec3 from, Vec3 to, std::int64_t block) {
    const int steps = static_cast<int>((to - from).norm() / 0.05);
    for (int i = 1; i < steps; ++i) {
      const Vec3 at = from + (to - from) * (static_cast<double>(i) / steps);
      ASSERT_EQ(places.find(at).value(), block) << i;
    }
  };
  along({0, 0, 0}, {10, 10, 0}, 0);
  along({10, 10, 0}, {10, 0, 0}, 1);
  along({10, 0, 0}, {0, 10, 0}, 2);
}

}  // namespace place_finder_test
}  // namespace twin::studies::linuxcnc

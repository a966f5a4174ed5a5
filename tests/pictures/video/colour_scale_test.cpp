#include "pictures/video/colour_scale.hpp"

#include <gtest/gtest.h>

namespace twin::pictures::video {
namespace colour_scale_test {

TEST(RoundUp, GivesTheNextRoundNumber) {
  EXPECT_DOUBLE_EQ(round_up(27.3), 30.0);
  EXPECT_DOUBLE_EQ(round_up(30.0), 30.0);
  EXPECT_DOUBLE_EQ(round_up(0.11), 0.15);
  EXPECT_DOUBLE_EQ(round_up(8.1), 10.0);
  EXPECT_DOUBLE_EQ(round_up(950.0), 1000.0);
  EXPECT_DOUBLE_EQ(round_up(0.0), 1.0);
}

double lightness(Colour colour) { return 0.30 * colour[0] + 0.59 * colour[1] + 0.11 * colour[2]; }

TEST(ColourScale, LightnessRisesWithTheErrorAndStopsAtTheEnd) {
  const ColourScale scale(27.0);
  EXPECT_EQ(scale.end_um(), 30.0);
  for (int i = 1; i <= 30; ++i) {
    EXPECT_GT(lightness(scale.colour(i)), lightness(scale.colour(i - 1))) << i;
  }
  EXPECT_EQ(scale.colour(31.0), scale.colour(30.0));
  EXPECT_EQ(scale.colour(-1.0), scale.colour(0.0));
}

}  // namespace colour_scale_test
}  // namespace twin::pictures::video

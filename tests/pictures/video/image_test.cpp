#include "pictures/video/image.hpp"

#include <gtest/gtest.h>

namespace twin::pictures::video {
namespace image_test {

TEST(Image, MixingIsLinearAndStaysInside) {
  Image image(4, 3, {100, 200, 0});
  image.mix(1, 2, {200, 0, 255}, 0.25);
  EXPECT_EQ(image.at(1, 2), (Colour{125, 150, 64}));
  Image before = image;
  for (const auto& [x, y] : {std::pair{-1, 0}, {4, 0}, {0, -1}, {0, 3}}) {
    image.mix(x, y, {0, 0, 0}, 1.0);
  }
  EXPECT_EQ(image, before);
}

TEST(Image, RectanglesAndPicturesAreCutAtTheEdge) {
  Image image(3, 3, {0, 0, 0});
  image.mix(Rectangle{2, 2, 10, 10}, {9, 9, 9}, 1.0);
  image.paste(Image(2, 2, {7, 7, 7}), -1, -1);
  image.paste(Image(2, 2, {5, 5, 5}), 10, 0);
  EXPECT_EQ(image.at(2, 2)[0], 9);
  EXPECT_EQ(image.at(0, 0)[0], 7);
  EXPECT_EQ(image.at(1, 0)[0], 0);
  EXPECT_EQ(image.at(0, 1)[0], 0);
}

TEST(Rectangle, UnionCoversBothAndIgnoresEmptyOnes) {
  const Rectangle both = united({1, 2, 3, 4}, {2, 0, 5, 1});
  EXPECT_EQ(both.x, 1);
  EXPECT_EQ(both.y, 0);
  EXPECT_EQ(both.width, 6);
  EXPECT_EQ(both.height, 6);
  EXPECT_EQ(united({}, {5, 6, 1, 1}).x, 5);
}

}  // namespace image_test
}  // namespace twin::pictures::video

#include "pictures/video/pen_trail.hpp"

#include <gtest/gtest.h>

namespace twin::pictures::video {
namespace pen_trail_test {

constexpr Colour kWhite{255, 255, 255};

PenTrail make_trail() {
  return {Canvas(100, 100, kWhite, 3.0), [](const Vec2& p) { return p; }, ColourScale(10.0), 0.1};
}

TraceRow row_at(double x, double y, double z, double error_um = 0.0) {
  TraceRow row;
  row.position = {x, y, z};
  row.error_um = error_um;
  return row;
}

TEST(PenTrail, DrawsWhereThePenIsDownAndNotWhereItIsUp) {
  PenTrail trail = make_trail();
  trail.advance(row_at(10, 50, 0));
  trail.advance(row_at(30, 50, 0));
  trail.advance(row_at(30, 50, 2));
  trail.advance(row_at(70, 50, 2));
  trail.advance(row_at(70, 50, 0));
  trail.advance(row_at(90, 50, 0));
  const Image& image = trail.canvas().image();
  EXPECT_NE(image.at(20, 50), kWhite);
  EXPECT_EQ(image.at(50, 50), kWhite);
  EXPECT_NE(image.at(80, 50), kWhite);
}

TEST(PenTrail, AShortPieceHandsItsErrorToTheNext) {
  PenTrail trail = make_trail();
  trail.advance(row_at(10, 50, 0, 0.0));
  trail.advance(row_at(10.1, 50, 0, 9.0));
  trail.advance(row_at(30, 50, 0, 1.0));
  EXPECT_EQ(trail.canvas().image().at(20, 50), ColourScale(10.0).colour(9.0));
}

}  // namespace pen_trail_test
}  // namespace twin::pictures::video

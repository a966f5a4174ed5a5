#include "pictures/video/canvas.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace twin::pictures::video {
namespace canvas_test {

constexpr Colour kWhite{255, 255, 255};
constexpr Colour kBlack{0, 0, 0};
constexpr Colour kRed{255, 0, 0};

/// Sum of the darkness of all pixels, 1 for a black one.
double darkness(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      sum += 1.0 - image.at(x, y)[0] / 255.0;
    }
  }
  return sum;
}

TEST(Canvas, ALineCoversItsLengthTimesItsWidth) {
  Canvas canvas(200, 200, kWhite, 4.0);
  canvas.line({30.0, 40.0}, {150.0, 130.0}, kBlack);
  EXPECT_NEAR(darkness(canvas.image()), 150.0 * 4.0 + std::numbers::pi * 4.0, 10.0);
}

TEST(Canvas, ManyShortPiecesLookLikeOneLine) {
  Canvas whole(100, 100, kWhite, 3.0);
  Canvas pieces(100, 100, kWhite, 3.0);
  const Vec2 a(10.2, 20.7);
  const Vec2 b(80.9, 60.1);
  whole.line(a, b, kBlack);
  for (int i = 0; i < 500; ++i) {
    pieces.line(a + i / 500.0 * (b - a), a + (i + 1) / 500.0 * (b - a), kBlack);
  }
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 100; ++x) {
      ASSERT_NEAR(whole.image().at(x, y)[0], pieces.image().at(x, y)[0], 2) << x << " " << y;
    }
  }
}

TEST(Canvas, TheLaterLineLiesOnTop) {
  Canvas canvas(40, 40, kWhite, 4.0);
  canvas.line({5, 20}, {35, 20}, kBlack);
  canvas.line({20, 5}, {20, 35}, kRed);
  EXPECT_EQ(canvas.image().at(20, 20), kRed);
  EXPECT_EQ(canvas.image().at(10, 20), kBlack);
  EXPECT_EQ(canvas.image().at(10, 10), kWhite);
}

TEST(Canvas, WhatIsOutsideDoesNoHarm) {
  Canvas canvas(20, 20, kWhite, 4.0);
  canvas.take_changed();
  canvas.line({-100, -100}, {-50, -60}, kBlack);
  canvas.line({1e6, 5}, {2e6, 5}, kBlack);
  EXPECT_EQ(canvas.take_changed().width, 0);
  EXPECT_EQ(darkness(canvas.image()), 0.0);
  canvas.line({-100, 10}, {100, 10}, kBlack);
  EXPECT_EQ(canvas.image().at(0, 10), kBlack);
  EXPECT_EQ(canvas.image().at(19, 10), kBlack);
}

TEST(Canvas, TheChangedPartHoldsEveryPixelThatChanged) {
  Canvas canvas(64, 64, kWhite, 3.0);
  EXPECT_EQ(canvas.take_changed().width, 64);  // all of it at first
  const Image before = canvas.image();
  canvas.line({20, 30}, {25, 41}, kBlack);
  canvas.line({25, 41}, {12, 44}, kBlack);
  const Rectangle changed = canvas.take_changed();
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool is_inside = x >= changed.x && x < changed.x + changed.width && y >= changed.y &&
                             y < changed.y + changed.height;
      ASSERT_TRUE(is_inside || canvas.image().at(x, y) == before.at(x, y));
    }
  }
  EXPECT_LT(changed.width * changed.height, 400);
}

}  // namespace canvas_test

namespace pen_trail_test {

constexpr Colour kWhite{255, 255, 255};

PenTrail make_trail() {
  return {Canvas(100, 100, kWhite, 3.0), [](const Vec2& p) { return p; }, ColourScale(10.0), 0.1};
}

TraceRow row_at(double x, double y, double z, double error_um = 0.0) {
  TraceRow row;
  row.position = {x, y, z};
  row.error_rms_um = error_um;
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

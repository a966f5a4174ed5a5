#include "geometry/smoothing/corner_bump.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::geometry {
namespace corner_bump_test {

constexpr double kCorner = 3.0;

/// A line up to the corner, a parabola behind it.
std::vector<geometry::SpanCubic> kinked(double width) {
  return {{kCorner - width, kCorner, {-width, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}},
          {kCorner, kCorner + width, {0, 0, 0}, {0.6, 0.8, 0}, {-0.4, 0.3, 0.1}, {0, 0, 0}}};
}

const CornerBump kBump{{-0.4, 0.8, 0.0}, {-0.8, 0.6, 0.2}};

TEST(CornerBump, MakesTheSumTwiceContinuous) {
  const double h = 0.7;
  auto pieces = kinked(h);
  add_bump(kBump, kCorner, h, pieces);
  ASSERT_EQ(pieces.size(), 4U);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    const geometry::SpanCubic& a = pieces[i - 1];
    const geometry::SpanCubic& b = pieces[i];
    const double t = a.end - a.begin;
    EXPECT_EQ(a.end, b.begin);
    EXPECT_LT((a.position(a.end) - b.c0).norm(), 1e-14);
    EXPECT_LT((a.c1 + t * (2.0 * a.c2 + 3.0 * t * a.c3) - b.c1).norm(), 1e-14);
    EXPECT_LT((a.second(a.end) - 2.0 * b.c2).norm(), 1e-13);
  }
}

TEST(CornerBump, LeavesThePathAloneAtItsEnds) {
  const double h = 0.7;
  const auto before = kinked(h);
  auto pieces = before;
  add_bump(kBump, kCorner, h, pieces);
  EXPECT_LT((pieces.front().c0 - before.front().c0).norm(), 1e-15);
  EXPECT_LT((pieces.front().c1 - before.front().c1).norm(), 1e-15);
  EXPECT_LT((pieces.front().c2 - before.front().c2).norm(), 1e-15);
  const double end = kCorner + h;
  EXPECT_LT((pieces.back().position(end) - before.back().position(end)).norm(), 1e-15);
  EXPECT_LT((pieces.back().second(end) - before.back().second(end)).norm(), 1e-14);
}

TEST(CornerBump, IsNoHigherThanItSays) {
  const double h = 0.7;
  const auto before = kinked(h);
  for (const CornerBump& bump : {kBump, CornerBump{kBump.turn, {}}, CornerBump{{}, kBump.bend}}) {
    auto pieces = before;
    add_bump(bump, kCorner, h, pieces);
    double largest = 0.0;
    for (const geometry::SpanCubic& piece : pieces) {
      for (int k = 0; k <= 200; ++k) {
        const double s = piece.begin + (piece.end - piece.begin) * k / 200.0;
        const Vec3 base = before[s < kCorner ? 0 : 1].position(s);
        largest = std::max(largest, (piece.position(s) - base).norm());
      }
    }
    EXPECT_LE(largest, bump.height(h));
    EXPECT_GE(largest, 0.6 * bump.height(h));
  }
}

TEST(CornerBump, IsAsWideAsTheHeightAllows) {
  for (const CornerBump& bump : {kBump, CornerBump{kBump.turn, {}}, CornerBump{{}, kBump.bend}}) {
    EXPECT_NEAR(bump.height(bump.width(0.01)), 0.01, 1e-15);
  }
  EXPECT_TRUE(std::isinf(CornerBump{}.width(0.01)));
}

}  // namespace corner_bump_test
}  // namespace twin::geometry

#include "geometry/smoothing/piecewise.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace twin::geometry {
namespace piecewise_test {

/// Pieces of a C2 spline on uneven knots.
std::vector<geometry::SpanCubic> spline() {
  std::vector<Vec3> points;
  for (int i = 0; i < 9; ++i) {
    points.emplace_back(i, std::sin(1.3 * i), 0.1 * i * i);
  }
  const auto curve = geometry::Curve::create(
      3, {0, 0, 0, 0, 0.001, 0.5, 0.6, 2.0, 2.1, 4.0, 4.0, 4.0, 4.0}, std::move(points));
  std::vector<geometry::SpanCubic> pieces;
  for (int span = 3; span < 9; ++span) {
    pieces.push_back(geometry::span_cubic(*curve, span));
  }
  return pieces;
}

TEST(Piecewise, ACurveIsItsPieces) {
  auto pieces = spline();
  for (geometry::SpanCubic& piece : pieces) {
    piece.begin += 7.0;
    piece.end += 7.0;
  }
  const geometry::Curve curve = curve_from_pieces(pieces);
  EXPECT_EQ(curve.u_min(), 0.0);
  EXPECT_NEAR(curve.u_max(), 4.0, 1e-12);
  for (const geometry::SpanCubic& piece : pieces) {
    for (int k = 0; k < 10; ++k) {
      const double s = piece.begin + (piece.end - piece.begin) * k / 10.0;
      const geometry::Derivatives at = curve.derivatives(s - 7.0);
      EXPECT_LT((at.position - piece.position(s)).norm(), 1e-11);
      EXPECT_LT((at.second - piece.second(s)).norm(), 1e-6 * (1.0 + piece.second(s).norm()));
    }
  }
}

TEST(Piecewise, APartIsTheSamePolynomial) {
  const geometry::SpanCubic whole = spline()[3];
  const geometry::SpanCubic part = part_of(whole, 1.1, 1.4);
  for (const double s : {1.1, 1.2, 1.4}) {
    EXPECT_LT((part.position(s) - whole.position(s)).norm(), 1e-14);
  }
}

TEST(Piecewise, SplitsThePieceThatHoldsAPlace) {
  auto pieces = spline();
  const std::size_t count = pieces.size();
  split_at(1.3, pieces);
  EXPECT_EQ(pieces.size(), count + 1);
  split_at(1.3, pieces);
  split_at(0.5 + 1e-9, pieces);
  EXPECT_EQ(pieces.size(), count + 1);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_EQ(pieces[i - 1].end, pieces[i].begin);
  }
}

}  // namespace piecewise_test
}  // namespace twin::geometry

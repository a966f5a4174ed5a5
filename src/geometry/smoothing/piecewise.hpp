#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/nurbs/curve.hpp"
#include "geometry/nurbs/span_cubic.hpp"

namespace twin::geometry {

/// Pieces are never made shorter [mm].
inline constexpr double kShortestPiece = 1e-6;

/// Length below which a part of a piece does not become a piece of its own [mm]; its neighbour is
/// extended over it. It is a thousandth of the length of the piece: where two pieces join C2, their
/// difference grows with the third power of the distance, and 1e-9 of it is rounding. A shorter
/// piece of width w would have a second derivative whose rounding grows as 1 / w^2.
inline double shortest_part(const geometry::SpanCubic& piece) noexcept {
  return std::clamp(1e-3 * (piece.end - piece.begin), kShortestPiece, 1e-4);
}

/// The same polynomial between other ends, about the first of them.
geometry::SpanCubic part_of(const geometry::SpanCubic& cubic, double begin, double end) noexcept;

/// Divides the piece that holds s in two, unless s is nearer to one of its ends than shortest_part.
void split_at(double s, std::vector<geometry::SpanCubic>& pieces);

/// Pieces that follow each other with two continuous derivatives as one clamped B-spline curve
/// whose parameter begins at 0.
///
/// With the blossom F_s of the polynomial of span s, control point i is F_s(u_{i+1}, u_{i+2},
/// u_{i+3}) for any of the spans s = i-3..i between its knots; of the polynomial
///   c_0 + c_1 t + c_2 t^2 + c_3 t^3   the blossom is
///   c_0 + c_1 (a + b + c) / 3 + c_2 (a b + b c + c a) / 3 + c_3 a b c.
/// The widest of the four spans is used, because its coefficients carry the least rounding.
geometry::Curve curve_from_pieces(std::span<const geometry::SpanCubic> pieces);

}  // namespace twin::geometry

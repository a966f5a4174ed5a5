#pragma once

#include "core/vec.hpp"
#include "geometry/nurbs/span_cubic.hpp"
#include "geometry/smoothing/polygon.hpp"

namespace twin::geometry {

/// A bound of the distance between a piece of a curve and a polygon, and where it comes from.
struct Deviation {
  double bound = 0.0;     ///< [mm]
  std::size_t block = 0;  ///< the block with the largest part in it
};

/// Bound of the distance, both ways, between one cubic of a curve C(s) and the polygon V(s) it was
/// fitted to, over s = cubic.begin .. cubic.end.
///
/// Over the part of block i within the span, C lies in the convex hull of its four Bezier points,
/// and the distance from a convex set, the chord, is a convex function: its largest value on the
/// hull is that at one of the four. This bounds every point of C from the chord.
///
/// The distance of the polygon from C is bounded as follows. C is continuous over the block, so its
/// projection onto the line of the chord covers everything between the projections of C(s_i) and
/// C(s_{i+1}). A point of the chord between those two is as near to C as the point of C that
/// projects onto it. A point of the chord before the projection of C(s_i) is no farther from C(s_i)
/// than the larger of |V_i - C(s_i)| and the distance of C(s_i) from its projection; the other end
/// is alike. So the distances |V_i - C(s_i)| of all vertices in the span are part of the bound, and
/// it holds both ways.
///
/// @param block    the block that holds cubic.begin
/// @param highest  the last block there is
/// @note Real-time safe.
Deviation chord_deviation(const geometry::SpanCubic& cubic, const Polygon& polygon,
                          std::size_t block, std::size_t highest) noexcept;

}  // namespace twin::geometry

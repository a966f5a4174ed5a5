#pragma once

#include <vector>

#include "geometry/nurbs/span_cubic.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// A stretch of an arc as C2 cubic pieces in its arc length.
///
/// A clamped B-spline on equal spans of width w. Its first and last three control points give it
/// position, tangent and curvature of the arc at both ends; the others are the blossoms of the
/// arc's Taylor polynomials,
///   P_j = C(t_{j+2}) - (w^2 / 6) C''(t_{j+2}).
/// The error e of a span has e'''' = -C'''', of size 1 / r^3 on a circle, and is bounded by
///   max |Bezier points of e's cubic Hermite interpolant| + w^4 / 384 max|C''''|;
/// w is made so small that this stays below 10 nm, with 4096 spans at most.
///
/// @param from, to  arc lengths on the arc [mm]
/// @param s0        added to the arc length to give the parameter of the pieces [mm]
/// @param pieces    gets the pieces appended
/// @returns the bound [mm]
double append_arc_pieces(const Arc& arc, double from, double to, double s0,
                         std::vector<geometry::SpanCubic>& pieces);

}  // namespace twin::path

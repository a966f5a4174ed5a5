#pragma once

#include <vector>

#include "geometry/nurbs/span_cubic.hpp"
#include "path/segment.hpp"

namespace twin::path {

/// A stretch of an arc as C2 cubic pieces in its arc length.
///
/// The pieces are the spans of a clamped B-spline on equal spans of width w. Its first and last
/// three control points give it the position, tangent and curvature of the arc at both ends. The
/// other control points are the blossoms of the Taylor polynomials of the arc,
///   P_j = C(t_{j+2}) - (w^2 / 6) C''(t_{j+2}).
/// On a span the error e has the fourth derivative -C'''', which is 1 / r^3 on a circle, so it is
/// at most
///   max |Bezier points of the cubic Hermite interpolant of e| + w^4 / 384 max|C''''|.
/// The width w is so small that this is below 10 nm, with 4096 spans at most.
///
/// @param from, to  arc lengths on the arc [mm]
/// @param s0        added to the arc length to give the parameter of the pieces [mm]
/// @param pieces    gets the pieces appended
/// @returns the bound [mm]
double append_arc_pieces(const Arc& arc, double from, double to, double s0,
                         std::vector<geometry::SpanCubic>& pieces);

/// The same of a curve. The error of a span is twice the largest distance that places in it show.
double append_curve_pieces(const FittedCurve& curve, double from, double to, double s0,
                           std::vector<geometry::SpanCubic>& pieces);

}  // namespace twin::path

#pragma once

#include <vector>

#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// A curve, or the part of it between two parameters, on a knot vector with more knots (knot
/// insertion).
///
/// With the blossom F_s of the polynomial piece on span s (its polar form in homogeneous
/// coordinates, symmetric and affine in each of its p arguments), the control points on the knots v
/// are
///   Q_i = F_s(v_{i+1}, ..., v_{i+p}),   u_s <= v_i < u_{s+1},
/// computed by de Boor's scheme with a new argument in each of its p rounds (the Oslo algorithm).
/// Source: L. Piegl, W. Tiller, The NURBS Book, 2nd ed., Sections 5.2 and 5.3.
///
/// @param knots  v, clamped and inside the domain; between its ends it has every knot of the curve
///               at least as often as the curve has it
Curve refine(const Curve& curve, std::vector<double> knots);

/// How a curve is cut into pieces.
struct SplitRule {
  int least_continuity = 0;  ///< cut at knots where fewer derivatives than this are continuous
  int most_spans = 0;        ///< and after so many spans; 0: no limit
};

/// Cuts a curve at some of its knots into pieces, each a curve of its own on clamped knots.
/// Together the pieces are the curve, up to rounding. Neighbours have the same control point where
/// they meet, bit for bit, and the first and last piece end in the ends of the curve.
std::vector<Curve> split(const Curve& curve, const SplitRule& rule);

/// The pieces of a curve over each of its spans: rational Bezier curves.
inline std::vector<Curve> bezier_pieces(const Curve& curve) { return split(curve, {0, 1}); }

}  // namespace twin::geometry

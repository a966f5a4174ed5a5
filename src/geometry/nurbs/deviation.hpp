#pragma once

#include <span>

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// Upper bound of the distance of a fitted curve from the polygon it was fitted to, over its whole
/// length [mm].
///
/// The piece of the curve between two points is compared with the chord between the same two
/// points. It is divided into four equal steps h of the parameter. The broken line through the five
/// places C(u_k) differs from C by at most h^2/8 max|C''|. C'' of a cubic is linear on each span,
/// so its maximum is at a knot or at an end of the piece. With n the part normal to the chord,
///   distance <= max_k |n_k| + h^2/8 max|C''_n|.
/// This bounds the distance from the straight line through the chord, and from the chord itself
/// where the curve certainly does not pass beyond its ends. Elsewhere the distance from the chord
/// and the whole of C'' take the place of the normal parts.
///
/// The bound exceeds the deviation itself by about 6 % on a smooth run.
///
/// @param curve       from Fitter::fit: cubic, not rational
/// @param points      the points C_0..C_n it passes through [mm]
/// @param parameters  their parameters, Fitter::parameters() [mm]
double deviation_bound(const Curve& curve, std::span<const Vec3> points,
                       std::span<const double> parameters);

}  // namespace twin::geometry

#pragma once

#include <span>

#include "core/vec.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// Upper bound of the distance of a fitted curve from the polygon it was fitted to, over its whole
/// length [mm].
///
/// The piece of the curve between two points is held against the chord between the same two points.
/// Of four equal steps h of the parameter, the broken line through C(u_k) differs from C by at most
/// h^2/8 max|C''|, and C'' of a cubic is linear on each span, so its maximum is at the knots and at
/// the ends of the piece. Across the chord that gives
///   distance <= max_k |n_k| + h^2/8 max|C''_n|,
/// n the part normal to the chord. It holds for the chord itself, not only for its line, where the
/// curve cannot run out past its ends; where that is not sure, distance from the chord and all of
/// C'' take the place of the normal parts.
///
/// The bound exceeds the deviation itself by about 6 % on a smooth run.
///
/// @param curve       from Fitter::fit: cubic, not rational
/// @param points      the points C_0..C_n it passes through [mm]
/// @param parameters  their parameters, Fitter::parameters() [mm]
double deviation_bound(const Curve& curve, std::span<const Vec3> points,
                       std::span<const double> parameters);

}  // namespace twin::geometry

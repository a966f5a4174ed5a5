#pragma once

#include "core/vec.hpp"
#include "feedrate/limits/axis_limits.hpp"
#include "geometry/nurbs/derivatives.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Derivatives of a curve by arc length, axis by axis.
struct ByArcLength {
  Vec3 first, second, third;
};

/// Derivatives by arc length from those by a parameter.
/// @param third  d3C/du3
ByArcLength by_arc_length(const geometry::Derivatives& at, const Vec3& third);

/// C''' of an arc at a place.
Vec3 arc_twist(const geometry::Arc& arc, const path::PathPoint& at);

/// Upper bounds of |C'|, |C''| and |C'''| between two places a and b, from their values at a, at b
/// and at the midpoint c.
///
/// |C'''| may exceed its largest sample by the bulge of the parabola through the three samples,
/// |C'''(c) - (C'''(a) + C'''(b)) / 2|. |C''| may exceed its largest sample by a quarter of the
/// interval times that bound, and |C'| likewise by the bound of |C''|: no place is farther than a
/// quarter of the interval from a sample.
PathBounds bounds_between(const ByArcLength& a, const ByArcLength& c, const ByArcLength& b,
                          double length);

/// The same of the derivatives as vectors, in the first component. What C'' v a and C''' v^3 add to the
/// vector of the jerk is no more than the sum of their lengths.
PathBounds vector_bounds_between(const ByArcLength& a, const ByArcLength& c, const ByArcLength& b,
                                 double length);

}  // namespace twin::feedrate

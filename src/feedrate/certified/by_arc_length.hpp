#pragma once

#include "geometry/arc.hpp"
#include "geometry/nurbs/curve.hpp"
#include "path/segment.hpp"

namespace twin::feedrate {

/// Derivatives of a curve by arc length, axis by axis.
struct ByArcLength {
  Vec3 first;   ///< dC/ds [-]
  Vec3 second;  ///< d2C/ds2 [1/mm]
  Vec3 third;   ///< d3C/ds3 [1/mm^2]
};

/// Derivatives by arc length from those by a parameter.
/// @param third  d3C/du3
ByArcLength by_arc_length(const geometry::Derivatives& at, const Vec3& third);

/// C''' of an arc. On a helix of radius r and rise 2 pi p, with c^2 = r^2 + p^2, it is the part of C'
/// across the axis, of length r / c, times -1 / c^2; and |C''| = r / c^2. So with that part T
///   C''' = -(|C''| / |T|)^2 T.
Vec3 arc_twist(const geometry::Arc& arc, const path::PathPoint& at);

}  // namespace twin::feedrate

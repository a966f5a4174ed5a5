#pragma once

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// Upper bounds of the absolute derivatives of a stretch of the path by arc length, axis by axis.
struct PathBounds {
  Vec3 tangent = Vec3::Zero();    ///< |dC/ds| [-]
  Vec3 curvature = Vec3::Zero();  ///< |d2C/ds2| [1/mm]
  Vec3 twist = Vec3::Zero();      ///< |d3C/ds3| [1/mm^2]
};

/// Whether any axis has a limit of its own.
bool has_axis_limits(const Limits& limits) noexcept;

/// Lowers the limits of a zone so far that every motion within them keeps those of each axis.
///
/// With the feedrate v, the tangential acceleration a and the tangential jerk j an axis has
///   velocity      t v
///   acceleration  t a + k v^2
///   jerk          t j + 3 k v a + k' v^3
/// where t, k, k' are its parts of the path's derivatives. The limits of the axis are shared out in
/// this order: the feedrate may use up 3/4 of its acceleration and 1/2 of its jerk, a gets the rest
/// of the acceleration and half the rest of the jerk, and j gets the jerk that is left. On a
/// straight line j gets all of it.
void keep_axis_limits(const PathBounds& path, const Limits& limits, LimitZone& zone) noexcept;

}  // namespace twin::feedrate

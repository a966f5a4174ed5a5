#pragma once

#include "path/segment.hpp"

namespace twin::feedrate {

/// Geometry of a place of the path of the path as a feedrate rule sees it.
struct LocalGeometry {
  double curvature = 0.0;  ///< kappa >= 0 [1/mm]
  double level = 1.0;      ///< share of the way that is in the XY plane, sqrt(x'^2 + y'^2), 0..1
  double turning = 0.0;    ///< heading in the XY plane per length of path, left positive [rad/mm]
};

/// The place with this tangent and curvature.
///
/// The heading is atan2(y', x'), so its derivative is (x' y'' - y' x'') / (x'^2 + y'^2): on a level
/// path the signed curvature. Where the path is vertical there is no heading and `turning` is 0.
LocalGeometry local_geometry(const path::PathPoint& at) noexcept;

}  // namespace twin::feedrate

#pragma once

#include "core/limits.hpp"
#include "feedrate/limits/local_geometry.hpp"

namespace twin::feedrate {

/// Feedrate of the tool's centre at which its point of contact moves along the surface at the
/// programmed feedrate.
///
/// The path is that of the centre of a cylinder of radius r whose axis is Z. With q the path's
/// projection into the XY plane and n its normal to the left, a tool on the left of the surface
/// (G41) touches it at c = q - r n. The projection advances by h = |q'| per length of path, and
/// n' = -(turning) q' / h, so c advances by
///   h + r turning                     on a level path 1 + kappa r, kappa > 0 to the left,
/// and with it z by sqrt(1 - h^2). On the right of the surface r counts negative. Hence
///   V = V_NC / sqrt((h + r turning)^2 + 1 - h^2).
/// For the curvature kappa_c = kappa / (1 + kappa r) of the surface this is V_NC (1 - kappa_c r):
/// slower in inside rounds, faster in outside ones. The rule is that of constant cutter contact
/// velocity [WY09, ref. 6].
///
/// Where h + r turning <= 0 the tool does not fit: it would cut away the surface that it touches.
/// There is no contact speed to keep, and the programmed feedrate stays.
///
/// @param feedrate  programmed feedrate V_NC > 0 [mm/s]
/// @param radius    tool radius r >= 0 [mm]
/// @returns [mm/s], more than V_NC on outside rounds
double contact_speed_feedrate(const LocalGeometry& at, double feedrate, double radius,
                              ToolSide side) noexcept;

}  // namespace twin::feedrate

#pragma once

#include <cstdint>

#include "core/limits.hpp"
#include "core/vec.hpp"
#include "feedrate/limits/zones.hpp"

namespace twin::feedrate {

/// Upper bounds of the absolute derivatives of a stretch of the path by arc length, axis by axis.
struct PathBounds {
  Vec3 tangent = Vec3::Zero();    ///< |dC/ds| [-]
  Vec3 curvature = Vec3::Zero();  ///< |d2C/ds2| [1/mm]
  Vec3 twist = Vec3::Zero();      ///< |d3C/ds3| [1/mm^2]
  /// 1 where d2C/ds2 and d3C/ds3 have one sign all along, -1 where they have opposite ones, else 0.
  Vec3 trend = Vec3::Zero();
};

/// Whether a bend lasts, or is the rounded corner between two stretches.
enum class BendKind : std::uint8_t { kLasting, kBrief };

/// Whether any axis has a limit of its own.
bool has_axis_limits(const Limits& limits) noexcept;

/// Lowers the limits of a zone so far that every motion within them keeps those of each axis.
///
/// With the feedrate v, the tangential acceleration a and the tangential jerk j an axis has
///   velocity      t v
///   acceleration  t a + k v^2
///   jerk          t j + 3 k v a + k' v^3
/// where t, k, k' are its parts of the path's derivatives. The limits of the axis are shared out:
///   of its acceleration k v^2 may use up 3/4, and a gets what is left;
///   of its jerk 3 k v a and k' v^3 together may use up 0.95 - 0.4 t, and j gets what they leave at
///   the feedrate where they use up the most.
/// On a straight line j gets all of it. Where k and k' have one sign the parts of a deceleration and
/// of k' v^3 have opposite signs, so that the larger of them counts, not the sum; where k and k' have
/// opposite signs this holds for an acceleration. So a bend that tightens leaves much for braking,
/// and one that opens leaves much for speeding up. The feedrate leaves so much that
/// a twentieth of sqrt(J v) can be had for a in both directions.
///
/// Acceleration and deceleration of the zone are those that are left at its limit. What more is left
/// at a lower feedrate is LimitZone::most, power and the fades.
///
/// @param bend  a brief one is so short that little has to be left for other motions in it
void keep_axis_limits(const PathBounds& path, const Limits& limits, BendKind bend,
                      LimitZone& zone) noexcept;

}  // namespace twin::feedrate

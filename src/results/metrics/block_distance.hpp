#pragma once

#include "core/vec.hpp"
#include "gcode/block.hpp"

/// Geometry of single blocks: how long they are, and how far from them a point is.
namespace twin::results {

/// How many axes a distance counts.
enum class View {
  kSpace,   ///< x, y and z
  kAlongZ,  ///< x and y: the path as seen along Z
};

/// A vector as it is seen: along Z it has no z.
inline Vec3 seen(const Vec3& v, View view) noexcept {
  return view == View::kSpace ? v : Vec3(v.x(), v.y(), 0.0);
}

/// A place on the programmed path, and how far a point is from it.
struct NearestPoint {
  double distance = 0.0;      ///< from the point to the place [mm]
  double fraction = 0.0;      ///< 0 at the block's start, 1 at its end [-]
  Vec3 point = Vec3::Zero();  ///< the place, z included [mm]
};

/// Point of a block at a fraction of its way; a block at rest (G04) is its start. @returns [mm]
Vec3 point_at(const gcode::Block& block, double fraction) noexcept;

/// Arc length of a block, or at least that: fraction f lies within length |f - g| of fraction g in
/// this view.
///
/// Exact for lines, and for arcs and helices in space; seen along Z an arc about the Z axis is
/// exact too; a tilted one (an ellipse) and a NURBS have their length in space, not less.
/// @returns [mm]
double block_length(const gcode::Block& block, View view) noexcept;

/// Place of a block between two fractions that is nearest to a point.
///
/// On a line it is the foot of the perpendicular. On an arc or helix the squared distance
///   D(f) = |C(f) - p|^2,  C(f) of geometry::Arc,
/// is sampled every 15 deg. Around each sample that is lower than its neighbours, Newton's method
/// inside a bracket (core/root.hpp) finds the root of D'(f) to 1e-13 of the way; a helix has a
/// minimum on each turn. A tilted arc that is seen along Z is an ellipse, whose twin minima may lie
/// as close as they like; it is sampled finer and finer instead. On a NURBS the samples are those of its
/// arc length.
///
/// @param point  [mm]
/// @param from, to  fractions, 0 <= from <= to <= 1
/// @note Real-time safe.
NearestPoint nearest(const gcode::Block& block, const Vec3& point, View view, double from = 0.0,
                     double to = 1.0) noexcept;

}  // namespace twin::results

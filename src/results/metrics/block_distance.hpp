#pragma once

#include "core/vec.hpp"
#include "gcode/block.hpp"

/// Geometry of single blocks: how long they are, and how far from them a point is.
namespace twin::results {

/// Which axes enter a distance.
enum class View {
  kSpace,   ///< x, y and z
  kAlongZ,  ///< x and y: the path as seen along Z
};

/// Returns a vector as seen in a view: along Z its z is 0.
inline Vec3 seen(const Vec3& v, View view) noexcept {
  return view == View::kSpace ? v : Vec3(v.x(), v.y(), 0.0);
}

/// The point of a block that is nearest to a given position.
struct NearestPoint {
  double distance = 0.0;      ///< distance of the position from the point, in the view [mm]
  double fraction = 0.0;      ///< share of the block's length up to the point, 0 to 1 [-]
  Vec3 point = Vec3::Zero();  ///< the point, z included [mm]
};

/// Point of a block at a fraction of its length; for a dwell (G04) always its place. @returns [mm]
Vec3 point_at(const gcode::Block& block, double fraction) noexcept;

/// Arc length of a block as seen in a view, or an upper bound of it.
///
/// The points at two fractions f and g are never farther apart than |f - g| times this length. The
/// length is exact for lines, and for arcs and helices in space. Seen along Z it is also exact for
/// an arc about the Z axis; for a tilted arc and for a NURBS it is the length in space, an upper
/// bound.
/// @returns [mm]
double block_length(const gcode::Block& block, View view) noexcept;

/// Finds the point of a block, between two fractions, that is nearest to a position.
///
/// On a line the nearest point is the foot of the perpendicular. On an arc or helix the squared
/// distance
///   D(f) = |C(f) - p|^2,  C(f) of geometry::Arc,
/// is sampled every 15 deg, since a helix has a minimum on each turn. Around each sample that is
/// lower than its neighbours, Newton's method inside a bracket (core/root.hpp) finds the root of
/// D'(f) to 1e-13 of the length. A tilted arc that is seen along Z is an ellipse. It may have two
/// minima as close to each other as one likes, so it is sampled more and more finely instead.
/// On a NURBS the samples are those of its arc length.
///
/// @param point     the position p [mm]
/// @param from, to  fractions, 0 <= from <= to <= 1
/// @note Real-time safe.
NearestPoint nearest(const gcode::Block& block, const Vec3& point, View view, double from = 0.0,
                     double to = 1.0) noexcept;

}  // namespace twin::results

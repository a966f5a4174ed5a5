#pragma once

#include <vector>

#include "core/vec.hpp"

/// Points on the curves of a made program, by formulas of this folder's own: nothing here is shared
/// with the reader or the planner.
namespace twin::fuzz {

/// A piece of curve as a polyline.
struct Shape {
  std::vector<Vec3> points;  ///< in order, both ends included [mm]
  double slack = 0.0;        ///< the curve is at most so far off the polyline [mm]
  double radius = 0.0;       ///< smallest radius of curvature; infinite on a line [mm]
};

/// A straight piece.
Shape line_shape(const Vec3& from, const Vec3& to);

/// An arc about a centre, or a helix, in the plane of two axes.
struct ArcOutline {
  Vec3 start = Vec3::Zero();   ///< [mm]
  Vec3 end = Vec3::Zero();     ///< [mm]
  Vec3 centre = Vec3::Zero();  ///< in the plane of the start [mm]
  int first = 0;               ///< axes of the plane: angles grow from `first` to `second`
  int second = 1;
  bool is_clockwise = false;
  bool is_full = false;  ///< a whole turn
};
Shape arc_shape(const ArcOutline& arc);

/// A NURBS by its definition: basis functions of Cox and de Boor, points weighted by them.
struct NurbsOutline {
  std::size_t degree = 2;
  std::vector<double> knots;
  std::vector<Vec3> points;  ///< control points [mm]
  std::vector<double> weights;
};
Shape nurbs_shape(const NurbsOutline& nurbs);

/// Length of a polyline [mm].
double length_of(const std::vector<Vec3>& points);

/// Largest share of each axis in the directions of a polyline, absolute values.
Vec3 directions_of(const std::vector<Vec3>& points);

}  // namespace twin::fuzz

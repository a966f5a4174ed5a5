#pragma once

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace twin::studies::circular {

/// A place seen from a centre.
struct PolarPoint {
  double angle = 0.0;   ///< from +X, counter-clockwise, 0 <= angle < 2 pi [rad]
  double radius = 0.0;  ///< distance from the centre [mm]
};

/// An angle put into [0, 2 pi) [rad].
double wrapped(double angle);

/// A closed path about a centre as radius over angle.
///
/// The points are sorted by angle, so that sense and start do not matter; between them the radius
/// is linear in the angle, across 0 too.
class PolarPath {
 public:
  /// @param points  one turn [mm], not empty
  PolarPath(std::span<const Vec2> points, const Vec2& centre);

  double radius_at(double angle) const;  ///< @param angle any [rad] @returns [mm]
  const std::vector<PolarPoint>& points() const { return points_; }

 private:
  std::vector<PolarPoint> points_;
};

}  // namespace twin::studies::circular

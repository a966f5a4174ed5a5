#pragma once

#include <span>

#include "core/vec.hpp"

namespace twin::studies::circular {

struct Circle {
  Vec2 centre = Vec2::Zero();  ///< [mm]
  double radius = 0.0;         ///< [mm]
};

/// Circle with the least sum of squared radial distances, sum (|p - c| - r)^2, by Gauss-Newton's
/// method from the points' mean.
///
/// @param points  a turn or more, at even steps [mm]
Circle least_squares_circle(std::span<const Vec2> points);

/// Two concentric circles that envelop all points with the least radial separation.
struct MinimumZone {
  Vec2 centre = Vec2::Zero();  ///< [mm]
  double separation = 0.0;     ///< [mm]
};

/// Minimum zone of a path that is nearly a circle.
///
/// About the centre c + d, with c that of the least-squares circle, the point at angle phi has the
/// radius |p - c| - (dx cos phi + dy sin phi) up to |d|^2 / r. The separation, largest less
/// smallest radius, is then convex in d, so a golden-section search over dx of the least over dy
/// finds it.
MinimumZone minimum_zone(std::span<const Vec2> points);

}  // namespace twin::studies::circular

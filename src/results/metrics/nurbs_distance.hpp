#pragma once

#include "results/metrics/block_distance.hpp"

namespace twin::results {

/// nearest() of a NURBS block.
///
/// The samples of its arc length stand a few degrees of turn apart. Beside each that is nearer than
/// its neighbours the root of
///   g(u) = (C(u) - p) . C'(u)
/// is found by Newton's method inside a bracket: no chords.
NearestPoint nearest_of_nurbs(const gcode::Block& block, const Vec3& point, View view, double from,
                              double to) noexcept;

}  // namespace twin::results

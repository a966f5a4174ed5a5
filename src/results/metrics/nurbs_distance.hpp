#pragma once

#include "results/metrics/block_distance.hpp"

namespace twin::results {

/// nearest() of a NURBS block.
///
/// The samples of the arc length stand a few degrees of turn apart. Around each sample that is
/// nearer than its neighbours, the minimum of the distance is the root of
///   g(u) = (C(u) - p) . C'(u),
/// which Newton's method finds inside the bracket of both neighbours. The curve itself is
/// evaluated, and no chord of it.
NearestPoint nearest_of_nurbs(const gcode::Block& block, const Vec3& point, View view, double from,
                              double to) noexcept;

}  // namespace twin::results

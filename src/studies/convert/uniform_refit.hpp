#pragma once

#include <optional>

#include "geometry/nurbs/curve.hpp"

namespace twin::studies::convert {

/// Whether the knots between the ends stand at equal distances, each once.
bool has_uniform_knots(const geometry::Curve& curve);

/// A cubic Q on uniform clamped knots that is near a cubic C on any knots, with as few spans as
/// possible.
///
/// Q has m spans of length L / m over the domain 0..L of C.
///   - Q takes C, C' and C'' of both ends over. They give its first and its last three control
///     points, so that neighbours which joined C with continuous tangent and curvature join Q so.
///   - The m - 3 other control points minimise the sum of |Q(u_k) - C(u_k)|^2 over densely spaced
///     u_k, eight to a span.
/// The distance of the two curves is taken as max_k |Q(u_k) - C(u_k)|; between the u_k it is not
/// looked at.
///
/// @param curve     cubic, not rational
/// @param distance  largest |Q - C| allowed [mm]
/// @param most      largest number of spans m, >= 3
/// @returns nullopt if no such curve is that near
std::optional<geometry::Curve> uniform_refit(const geometry::Curve& curve, double distance,
                                             int most);

}  // namespace twin::studies::convert

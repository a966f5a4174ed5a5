#pragma once

#include <optional>

#include "geometry/nurbs/curve.hpp"

namespace twin::studies::convert {

/// Whether the knots between the ends stand at equal distances, each once.
bool has_uniform_knots(const geometry::Curve& curve);

/// A cubic on uniform clamped knots near a cubic on any knots, with the fewest spans up to a most.
///
/// Over the same domain 0..L, m spans of length L / m:
///   - C, C' and C'' of both ends are taken over: they give the first and the last three control
///     points, so that neighbours which join with continuous tangent and curvature still do;
///   - the m - 3 others make the sum of |Q(u_k) - C(u_k)|^2 over densely spaced u_k least.
/// The distance of the two curves is at most max_k |Q(u_k) - C(u_k)|, but for what lies between the
/// u_k, which stand eight to a span.
///
/// @param curve     cubic, not rational
/// @param distance  largest |Q - C| allowed [mm]
/// @param most      largest number of spans, >= 3
/// @returns nullopt if no such curve is that near
std::optional<geometry::Curve> uniform_refit(const geometry::Curve& curve, double distance,
                                             int most);

}  // namespace twin::studies::convert

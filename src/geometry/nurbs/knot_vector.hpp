#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/error.hpp"

/// The non-periodic knot vector of a curve with n+1 control points and degree p [WY09, Eq. 8],
///   U = {u_0, ..., u_{n+p+1}},   u_0 = ... = u_p < ... < u_{n+1} = ... = u_{n+p+1}.
///
/// Span s is the half-open interval [u_s, u_{s+1}). The spans of the domain are p..n; some of them
/// are empty where a knot is repeated. The last span is closed, so that it holds the end of the
/// domain.
namespace twin::geometry {

/// Highest degree p of a curve.
inline constexpr int kMaxDegree = 5;

/// Says what is wrong with a knot vector, if anything: count, order, ends, or a knot repeated so
/// often that the curve would fall apart (an inner knot may occur p times).
Expected<void> check_knot_vector(int degree, std::span<const double> knots,
                                 std::size_t control_points);

/// Index s of the span that holds u, p <= s <= n, with u clamped to the domain (NaN to its
/// beginning).
///
/// @param hint  a span to try first, then its two neighbours; anything outside p..n is no hint
/// @note Real-time safe. The knot vector must have passed check_knot_vector.
int find_span(int degree, std::span<const double> knots, double u, int hint) noexcept;

/// Knots by averaging for interpolation at the parameters t_0 <= ... <= t_n, n >= p [WY09, Eq. 15]:
///   u_{j+p} = (t_j + ... + t_{j+p-1}) / p,   j = 1..n-p,
/// with p+1 knots at each end. A parameter stands in `t` as often as there are conditions on the
/// curve there (point, first and second derivative: three times).
///
/// @param knots  gets the n+p+2 knots, in the unit of t
void average_knots(int degree, std::span<const double> t, std::vector<double>& knots);

}  // namespace twin::geometry

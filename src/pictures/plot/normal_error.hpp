#pragma once

#include "core/vec.hpp"

namespace twin::pictures {

/// The part of a position error that is square to the path.
///
/// Near the set point b the path is taken as its osculating circle, the one through the set points
/// a, b, c before, at and after. With centre m, radius r and the measured position q, the vector
/// from the circle to q is
///   e = (q - m) (1 - r / |q - m|),
/// which has no lag in it: a table that follows the circle late has e = 0. On a straight stretch it
/// is q - b less its part along the path; so it is where the error is no longer small against r.
///
/// @param a,b,c     successive set points [mm]; b = c or a = b at rest
/// @param measured  position q that belongs to b [mm]
/// @returns e [mm]; zero where a, b and c coincide, for then no direction is square to the path
Vec2 normal_error(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& measured);

}  // namespace twin::pictures

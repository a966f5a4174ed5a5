#pragma once

#include "core/error.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::geometry {

/// The full circle parallel to the XY plane, counter-clockwise from (centre.x + radius, centre.y),
/// as an exact rational curve on 0 <= u <= 1 with one quarter to each 1/4 of u.
///
/// A quarter is the rational parabola with control points A, B, C, where B is the meeting point of
/// the tangents in A and C, and weights 1, cos 45 deg, 1. Degree 3 is the same curve with the
/// degree of each quarter raised by one. In homogeneous coordinates its control points are
///   A,   (A + 2 B) / 3,   (2 B + C) / 3,   C.
///
/// @param centre  centre [mm]
/// @param radius  radius > 0 [mm]
/// @param degree  2 or 3
Expected<Curve> full_circle(const Vec3& centre, double radius, int degree = 2);

}  // namespace twin::geometry

#pragma once

#include "core/vec.hpp"
#include "geometry/nurbs/derivatives.hpp"

namespace twin::geometry {

/// Circular arc or helix in space, seen from its axis.
///
///              e2                       The frame is right-handed: the axis is e1 x e2, and the
///               |     . - C(1)          angle a grows from e1 to e2, whatever the sense in which
///               |  .                    the arc is seen from above.
///               | .  a = sweep
///     centre    +---------- C(0)  e1
///
/// With a(f) = f sweep and r(f) = radius + f radius_change, the point at fraction f in [0, 1] is
///   C(f) = centre + r(f) (cos a(f) e1 + sin a(f) e2) + f rise (e1 x e2).                      (1)
/// At f = 0 it is the start of the arc, at f = 1 its end. radius_change is the rounding of a
/// program's numbers: an arc is given by more numbers than it has degrees of freedom.
struct Arc {
  Vec3 centre = Vec3::Zero();  ///< centre, at the height of the start point [mm]
  Vec3 e1 = Vec3::UnitX();     ///< unit vector from the centre to the start point
  Vec3 e2 = Vec3::UnitY();     ///< unit vector, 90 deg further in the sense of motion
  double radius = 0.0;         ///< radius at the start, > 0 [mm]
  double radius_change = 0.0;  ///< radius at the end less radius at the start [mm]
  double sweep = 0.0;          ///< angle travelled, > 0 [rad]
  double rise = 0.0;           ///< travel along e1 x e2 over the whole arc, signed [mm]
};

/// C(f) by Eq. (1) [mm]. @note Real-time safe.
Vec3 point_at(const Arc& arc, double fraction) noexcept;

/// C(f), C'(f) and C''(f) with respect to the fraction. @note Real-time safe.
Derivatives derivatives_at(const Arc& arc, double fraction) noexcept;

/// |C'(f)|, the arc length per fraction: sqrt((r(f) sweep)^2 + radius_change^2 + rise^2) [mm].
/// @note Real-time safe.
double speed_at(const Arc& arc, double fraction) noexcept;

/// Arc length from fraction 0 to f, by Gauss-Legendre quadrature of the speed with four points
/// [mm]. It is exact where the radius does not change. @note Real-time safe.
double length_to(const Arc& arc, double fraction) noexcept;

/// Fraction in [0, 1] at arc length s, the inverse of length_to(). s is clamped to the arc.
///
/// It is s / length where the radius does not change. Elsewhere three Newton steps from there leave
/// rounding only, since the radius changes by the rounding of a program's numbers.
///
/// @param length  length_to(arc, 1) [mm]
/// @note Real-time safe.
double fraction_at(const Arc& arc, double s, double length) noexcept;

/// The part of an arc between two fractions, from < to; exact. @note Real-time safe.
Arc part_of(const Arc& arc, double from, double to) noexcept;

}  // namespace twin::geometry

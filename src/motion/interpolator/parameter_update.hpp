#pragma once

#include <array>

#include "geometry/nurbs/arc_length.hpp"
#include "geometry/nurbs/curve.hpp"

namespace twin::motion {

/// Second-order Taylor step of the parameter over a period T at feedrate V and tangential
/// acceleration A:
///   u' = u + V T / |C'| + (T^2 / 2) (A / |C'| - V^2 (C' . C'') / |C'|^4)      [WY09, Eq. 23].
/// The paper prints |C'|^3 inside a bracket with 1/|C'| before it, which is the same.
/// @note Real-time safe.
double taylor_step(const geometry::Derivatives& at, double u, double feedrate, double acceleration,
                   double period) noexcept;

/// First-order Taylor step, u' = u + V T / |C'|.
/// @note Real-time safe.
double first_order_step(const geometry::Derivatives& at, double u, double feedrate,
                        double period) noexcept;

/// Classical Runge-Kutta step of du/dt = V(t) / |C'(u)| over a period T, with the feedrate at its
/// begin, middle and end [mm/s]. @p at are the derivatives at u.
/// @note Real-time safe.
double runge_kutta_step(const geometry::Curve& curve, const geometry::Derivatives& at, double u,
                        const std::array<double, 3>& feedrate, double period) noexcept;

/// Parameter of the place at arc length s: the Taylor step predicts it, and where it misses s by
/// more than the arc length can tell, Newton steps on s(u) correct it. The step from one sample to
/// the next is then exact, and no error adds up along the curve.
/// @note Real-time safe.
double corrected_parameter(const geometry::Curve& curve, const geometry::ArcLength& arc_length,
                           double s, double predicted) noexcept;

}  // namespace twin::motion

#pragma once

#include "nc_programs/generate/nc_text.hpp"
#include "nc_programs/generate/rational_curve.hpp"

namespace twin::programs {

/// The butterfly, a NURBS of degree 3 with 51 control points that the literature on NURBS
/// interpolators shares. Length 382.859558 mm; smallest radius 0.0231 mm at u = 0.25635.
RationalCurve butterfly_curve();

/// butterfly.nc: X0 Y0 -> start, the curve in chords that deviate 1 um at most, straight back.
ProgramFile butterfly_program();

/// butterfly_nurbs.nc: the curve itself, by control points, knots and weights.
ProgramFile butterfly_nurbs_program();

}  // namespace twin::programs

#pragma once

#include <vector>

#include "nc_programs/generate/nc_text.hpp"
#include "nc_programs/generate/outline_program.hpp"
#include "nc_programs/generate/rational_curve.hpp"

/// The programs of nc_programs/, each by its name.
namespace twin::programs {

/// Three heart-shaped leaflets joined at the centre; six tight rounds.
OutlineSpec oxalis();

/// A leaping dolphin from the side; eight tight rounds.
OutlineSpec dolphin();

/// The butterfly, a NURBS of degree 3 with 51 control points that the literature on NURBS
/// interpolators shares. Length 382.859558 mm; smallest radius 0.0231 mm at u = 0.25635.
RationalCurve butterfly_curve();

/// butterfly.nc: X0 Y0 -> start, the curve in chords that deviate 1 um at most, straight back.
ProgramFile butterfly_program();

/// butterfly_nurbs.nc: the curve itself, by control points, knots and weights.
ProgramFile butterfly_nurbs_program();

/// circle.nc: arcs in both senses, full, quarter and three-quarter, with I J and with R.
ProgramFile circle_program();

/// square.nc: a 40 mm square, then a zigzag of corner angles from 165 to 15 degrees.
ProgramFile square_program();

/// mixed.nc: rapids, lifts of the pen, long lines, arcs, a helix, short blocks, dwell, feedrates,
/// G61 and G91.
ProgramFile mixed_program();

/// identify.nc: strokes and circles that show friction, drive and mass of both axes in a short
/// time.
ProgramFile identify_program();

/// zigzag.nc: 1,000 blocks of 0.1 mm, each square to the one before.
ProgramFile zigzag_program();

/// star.nc: a star of five points in blocks of 0.5 mm, and a smaller one in whole lines.
ProgramFile star_program();

/// gear.nc: the outline of a spur gear in blocks of 0.2 mm, sharp at the tips of the teeth and
/// rounded at their roots.
ProgramFile gear_program();

/// trochoid.nc: 200,000 blocks of 0.1 mm, loops of radius 2 mm along a circle; too large to be
/// kept.
ProgramFile trochoid_program();

/// Every program of nc_programs/, as it is to be written.
/// @throws std::runtime_error if an outline cannot be rounded
std::vector<ProgramFile> all_programs();

}  // namespace twin::programs

#pragma once

#include "nc_programs/generate/nc_text.hpp"

namespace twin::programs {

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

}  // namespace twin::programs

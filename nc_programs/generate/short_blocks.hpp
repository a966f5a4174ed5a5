#pragma once

#include "nc_programs/generate/nc_text.hpp"

namespace twin::programs {

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

}  // namespace twin::programs

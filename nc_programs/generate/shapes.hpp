#pragma once

#include "nc_programs/generate/outline_program.hpp"

namespace twin::programs {

/// Three heart-shaped leaflets joined at the centre; six tight rounds.
OutlineSpec oxalis();

/// A leaping dolphin from the side; eight tight rounds.
OutlineSpec dolphin();

}  // namespace twin::programs

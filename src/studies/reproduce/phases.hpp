#pragma once

#include "hal/mujoco/table_params.hpp"

namespace twin::studies::reproduce {

/// The table as another run of it would find it: encoders and hum elsewhere in their cycle.
///
/// With g the root of g^4 = g + 1, repeat k moves the phase of the X encoder by k / g, that of the
/// Y encoder by k / g^2 and the hum of both axes, which hang on one mains, by k / g^3 of a cycle.
/// These points fill the cube of phases evenly however many there are, a generalised golden-ratio
/// sequence. Repeat 0 is the table as it is.
hal::mujoco::TableParams with_phases_of_repeat(hal::mujoco::TableParams table, int repeat);

}  // namespace twin::studies::reproduce

#pragma once

#include "twin/machine.hpp"

/// The signals at the wires between controller and machine, under their names in this room.
namespace twin::hal {

using twin::Axis;
using twin::Inputs;
using twin::kServoAxes;
using twin::kX;
using twin::kY;
using twin::Outputs;
using twin::Truth;

}  // namespace twin::hal

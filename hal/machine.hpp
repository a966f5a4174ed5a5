#pragma once

#include <string>
#include <utility>

#include "core/error.hpp"
#include "twin/machine.hpp"

/// The seam between controller and plant, and the signals at the wires between them
/// (twin/machine.hpp), under their names in this room.
namespace twin::hal {

using twin::Axis;
using twin::Inputs;
using twin::kServoAxes;
using twin::kX;
using twin::kY;
using twin::Machine;
using twin::MachineInfo;
using twin::Outputs;
using twin::Truth;
using State = MachineState;
using Status = MachineStatus;

/// Why a machine cannot be configured or activated.
inline Error refusal(std::string message) {
  return Error{ErrorCode::kMachine, std::move(message), {}, 0, 0};
}

}  // namespace twin::hal

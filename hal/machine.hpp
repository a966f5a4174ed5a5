#pragma once

#include <string>
#include <utility>

#include "core/error.hpp"
#include "hal/signals.hpp"

/// The seam between controller and plant (twin/machine.hpp), under its names in this room.
namespace twin::hal {

using twin::Machine;
using twin::MachineInfo;
using State = MachineState;
using Status = MachineStatus;

/// Why a machine cannot be configured or activated.
inline Error refusal(std::string message) {
  return Error{ErrorCode::kMachine, std::move(message), {}, 0, 0};
}

}  // namespace twin::hal

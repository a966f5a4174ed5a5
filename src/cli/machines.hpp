#pragma once

#include <memory>
#include <string>

#include "config/machine_file.hpp"
#include "hal/machine.hpp"

namespace twin::cli {

/// The HAL switch: the machine of a name, "mujoco" or "ideal", with the parameters of a machine
/// file.
std::unique_ptr<hal::Machine> make_machine(const std::string& hal,
                                           const config::MachineFile& machine);

}  // namespace twin::cli

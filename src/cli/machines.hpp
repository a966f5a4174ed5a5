#pragma once

#include <memory>
#include <string>

#include "cli/options.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"

namespace twin::cli {

/// A simulated machine by its name, "mujoco" or "ideal", with the parameters of a machine file.
std::unique_ptr<hal::Machine> make_machine(const std::string& hal,
                                           const config::MachineFile& machine);

/// The HAL switch: the machine of --hal and --rig. A real one is confirmed by the user first.
///
/// @param what  what it is about to do, as in "run dolphin.nc"
Expected<std::unique_ptr<hal::Machine>> open_machine(const Options& options,
                                                     const config::MachineFile& machine,
                                                     const std::string& what);

}  // namespace twin::cli

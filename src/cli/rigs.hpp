#pragma once

#include <memory>
#include <string>

#include "cli/arguments.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/assemble/rig_ports.hpp"
#include "hal/rig/rig_machine.hpp"

/// The rig of --rig, from the options of the command line.
namespace twin::cli {

/// Name of the shared memory of an emulator's process: that of --rig-name, or the user's own.
std::string shared_name(const RigArguments& arguments);

/// The rig put together, and confirmed by the user if it is real.
///
/// @param purpose  what it is about to do, as in "run dolphin.nc"
Expected<std::unique_ptr<hal::rig::RigMachine>> open_rig(const RigArguments& arguments,
                                                         const config::MachineFile& machine,
                                                         const std::string& purpose);

/// A rig that is only looked at.
struct RigToLookAt {
  config::MachineFile machine;
  hal::rig::assemble::RigKind kind = hal::rig::assemble::RigKind::kEmulated;
  hal::rig::RigSettings settings;  ///< wires; emulated cards always read V-REF back
  hal::rig::assemble::RigPorts ports;
};

/// Opens the registers of the rig without writing to them.
Expected<RigToLookAt> open_to_look(const RigArguments& arguments, config::MachineFile machine);

}  // namespace twin::cli

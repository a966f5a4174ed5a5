#pragma once

#include <memory>
#include <string>

#include "cli/arguments.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/rig/rig_machine.hpp"
#include "session/machine.hpp"

/// From the options of a command to machine file and machine.
namespace twin::cli {

/// The machine file with the settings of the command line. What the reader notes of it is printed
/// on stderr unless the command is quiet.
Expected<config::MachineFile> read_machine(const MachineArguments& arguments, Verbosity verbosity);

/// What makes the machine of --hal. A real one is confirmed by the user first.
session::MakeMachine machine_of(const HalArguments& arguments);

/// The rig of --rig, put together, and confirmed by the user if it is real.
///
/// @param purpose  what it is about to do, as in "run dolphin.nc"
Expected<std::unique_ptr<hal::rig::RigMachine>> open_rig(const RigArguments& arguments,
                                                         const config::MachineFile& machine,
                                                         const std::string& purpose);

/// "x" or "y" as an axis.
hal::Axis axis_of(const std::string& name);

}  // namespace twin::cli

#pragma once

#include <string>

#include "cli/arguments.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/machine.hpp"
#include "session/machine.hpp"

/// From the options of a command to machine file and machine.
namespace twin::cli {

/// The machine file with the settings of the command line. What the reader notes of it is printed
/// on stderr unless the command is quiet.
Expected<config::MachineFile> read_machine(const MachineArguments& arguments, Verbosity verbosity);

/// What makes the machine of --hal. A real one is confirmed by the user first.
session::MakeMachine machine_of(const HalArguments& arguments);

/// "x" or "y" as an axis.
hal::Axis axis_of(const std::string& name);

}  // namespace twin::cli

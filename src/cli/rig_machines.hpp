#pragma once

#include <memory>
#include <string>

#include "cli/options.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/rig/assemble/make_rig.hpp"

/// The rig behind --hal rig, from the options of the command line.
namespace twin::cli {

using hal::rig::assemble::RigKind;

/// Finds out which rig --rig means.
Expected<RigKind> find_rig(const Options& options, const config::MachineFile& machine);

/// What a rig is put together from, without guard, faults and log.
hal::rig::assemble::RigSetup setup_of(const Options& options, const config::MachineFile& machine);

/// The rig of --rig, put together, and confirmed by the user if it is real.
///
/// @param what  what it is about to do, as in "run dolphin.nc"
Expected<std::unique_ptr<hal::rig::RigMachine>> open_rig(const Options& options,
                                                         const config::MachineFile& machine,
                                                         const std::string& what);

/// Name and scales of the rig of a machine file.
hal::MachineInfo machine_info(const config::MachineFile& machine);

}  // namespace twin::cli

#pragma once

#include "cli/arguments.hpp"
#include "cli/rig_machines.hpp"
#include "cli/rig_ports.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"

namespace twin::cli {

/// A rig that is only looked at.
struct RigToLookAt {
  config::MachineFile machine;
  RigKind kind = RigKind::kEmulated;
  hal::rig::RigSettings settings;  ///< wires; emulated cards always read V-REF back
  RigPorts ports;
};

/// Finds the rig of --rig and opens its registers without writing to them.
Expected<RigToLookAt> open_to_look(const RigArguments& options, config::MachineFile machine);

}  // namespace twin::cli

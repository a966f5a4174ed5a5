#pragma once

#include "cli/options.hpp"
#include "cli/rig_machines.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/rig/assemble/rig_ports.hpp"

namespace twin::cli {

using hal::rig::assemble::RigPorts;

/// A rig that is only looked at.
struct RigToLookAt {
  config::MachineFile machine;
  RigKind kind = RigKind::kEmulated;
  hal::rig::RigSettings settings;  ///< wires; emulated cards always read V-REF back
  RigPorts ports;
};

/// Finds the rig of --rig and opens its registers without writing to them.
Expected<RigToLookAt> open_to_look(const Options& options);

}  // namespace twin::cli

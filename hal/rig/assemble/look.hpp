#pragma once

#include "core/error.hpp"
#include "hal/rig/assemble/find_rig.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/assemble/rig_ports.hpp"

namespace twin::hal::rig::assemble {

/// Opens the registers of a rig without writing to them.
///
/// Emulated boards in this process have let one period pass after power on, so that they show
/// something.
/// @param period  interpolation period [s]
Expected<RigPorts> open_to_look(RigKind kind, const RigSetup& setup, double period);

/// The wiring with which a rig is looked at: emulated cards always read V-REF back.
RigSettings wiring_to_look_with(RigKind kind, const RigSettings& wiring);

}  // namespace twin::hal::rig::assemble

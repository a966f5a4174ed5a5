#pragma once

#include <memory>

#include "core/error.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/io_port/io_port.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::assemble {

/// Registers of the two cards.
struct RigPorts {
  std::shared_ptr<void> owner{};  ///< of what is behind them, where they do not own it
  std::unique_ptr<io_port::IoPort> pci1716;
  std::unique_ptr<io_port::IoPort> pci1784;
};

/// Ports onto emulated boards, laid out as the settings of the cards have it.
RigPorts ports_of(boards::BoardRegisters& boards, const RigSettings& settings,
                  std::shared_ptr<void> owner = nullptr);

/// Opens the registers of a rig without writing to them.
///
/// Emulated boards in this process have let one period pass after power on, so that they show
/// something.
/// @param period  interpolation period [s]
Expected<RigPorts> open_to_look(RigKind kind, const RigSetup& setup, double period);

/// The wiring with which a rig is looked at: emulated cards always read V-REF back.
RigSettings wiring_to_look_with(RigKind kind, const RigSettings& wiring);

}  // namespace twin::hal::rig::assemble

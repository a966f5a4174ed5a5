#pragma once

#include <memory>

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

}  // namespace twin::hal::rig::assemble

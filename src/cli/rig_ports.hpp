#pragma once

#include <memory>
#include <string>

#include "cli/arguments.hpp"
#include "hal/rig/boards/board_registers.hpp"
#include "hal/rig/io_port/io_port.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::cli {

/// Registers of the two cards.
struct RigPorts {
  std::shared_ptr<void> owner{};  ///< of what is behind them, where they do not own it
  std::unique_ptr<hal::rig::io_port::IoPort> pci1716;
  std::unique_ptr<hal::rig::io_port::IoPort> pci1784;
};

/// Ports onto emulated boards, laid out as the settings of the cards have it.
RigPorts ports_of(hal::rig::boards::BoardRegisters& boards, const hal::rig::RigSettings& settings,
                  std::shared_ptr<void> owner = nullptr);

/// Name of the shared memory that an emulator's process has: --rig-name, or the user's own.
std::string shared_name(const RigArguments& options);

}  // namespace twin::cli

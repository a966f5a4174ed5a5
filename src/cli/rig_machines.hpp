#pragma once

#include <memory>
#include <string>

#include "cli/arguments.hpp"
#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "hal/rig/rig_machine.hpp"

/// The rig behind --hal rig: which one it is, and how it is put together.
namespace twin::cli {

/// What stands behind the registers.
enum class RigKind {
  kCards,     ///< the real cards: metal moves
  kProcess,   ///< emulated boards of another process, `twin rig emulate`, on the wall clock
  kEmulated,  ///< emulated boards in this process, in simulated time
};

/// Finds out which rig --rig means. "auto" is the real cards or an emulator's process, whichever is
/// there; that both are there is an error, and that neither is one that names what was looked for.
Expected<RigKind> find_rig(const RigArguments& options, const config::MachineFile& machine);

/// Puts a rig together: cards, what is behind them, and, where the outputs outlive this process,
/// the guard that watches it. Nothing is opened before configure().
Expected<std::unique_ptr<hal::rig::RigMachine>> make_rig(RigKind kind, const RigArguments& options,
                                                         const config::MachineFile& machine);

/// The rig of --rig, put together.
Expected<std::unique_ptr<hal::rig::RigMachine>> assemble_rig(const RigArguments& options,
                                                             const config::MachineFile& machine);

/// Name and scales of the rig of a machine file.
hal::MachineInfo machine_info(const config::MachineFile& machine);

/// "real cards", "emulated boards of process 1234 (simulated)".
std::string describe(RigKind kind);

}  // namespace twin::cli

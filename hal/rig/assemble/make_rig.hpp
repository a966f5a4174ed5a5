#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/table_params.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/rig_machine.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::assemble {

/// What stands behind the registers.
enum class RigKind {
  kCards,     ///< the real cards: metal moves
  kProcess,   ///< emulated boards of another process, `twin rig emulate`, on the wall clock
  kEmulated,  ///< emulated boards in this process, in simulated time
};

/// "real cards", "emulated boards (simulated)".
std::string describe(RigKind kind);

/// Finds out which rig is meant.
///
/// "auto" is the real cards or an emulator's process, whichever is there; that both are there is an
/// error, and that neither is one that names what was looked for.
/// @param wanted       "auto", "cards", "process" or "emulated"
/// @param shared_name  of the shared memory of an emulator's process
Expected<RigKind> find_rig(const std::string& wanted, const RigSettings& wiring,
                           const std::string& shared_name);

/// What a rig is put together from.
struct RigSetup {
  mujoco::TableParams table;        ///< of emulated boards, and scales that the wiring leaves out
  RigSettings wiring;               ///< cards, wires and signals
  double heartbeat_timeout = 0.02;  ///< after which the guard acts [s]
  std::filesystem::path guard_program;  ///< twin-guard; for kCards and kProcess
  std::string shared_name;              ///< of the emulator's shared memory; for kProcess
  std::vector<emulator::Fault> faults;  ///< that strike emulated boards; for kEmulated
  /// Told of the emulated rig when all is over, may be empty; for kEmulated.
  std::function<void(emulator::EmulatedRig&)> at_end;
};

/// Puts a rig together: cards, what is behind them, and, where the outputs outlive this process,
/// the guard that watches it. Nothing is opened before configure(), but for the shared memory of an
/// emulator's process. Installs the handlers of emergency.hpp.
Expected<std::unique_ptr<RigMachine>> make_rig(RigKind kind, RigSetup setup);

/// The same for emulated boards in this process, which need neither guard nor handlers.
std::unique_ptr<RigMachine> make_emulated_rig(RigSetup setup);

/// Name and scales of a rig.
MachineInfo rig_info(const RigSettings& wiring, const mujoco::TableParams& table);

}  // namespace twin::hal::rig::assemble

#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "hal/mujoco/table_params.hpp"
#include "hal/rig/assemble/find_rig.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/rig_machine.hpp"
#include "hal/rig/rig_settings.hpp"

namespace twin::hal::rig::assemble {

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

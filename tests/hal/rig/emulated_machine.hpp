#pragma once

#include <memory>

#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/rig_machine.hpp"

namespace twin::hal::rig::testing {

/// The rig over emulated cards in lockstep; `bench` is shared with the test.
inline std::unique_ptr<RigMachine> make_emulated(const mujoco::TableParams& table,
                                                 std::shared_ptr<emulator::EmulatedRig> bench,
                                                 const RigSettings& settings) {
  const MachineInfo info = mujoco::MujocoMachine(table).info();
  emulator::EmulatedRig& rig = *bench;
  const auto open = [&rig, settings] {
    return RegisterCards::open(std::make_unique<boards::EmulatedPci1716>(rig.boards().pci1716),
                               std::make_unique<boards::EmulatedPci1784>(rig.boards().pci1784),
                               settings);
  };
  return std::make_unique<RigMachine>(
      settings, TableScales{info.mm_per_count, info.mm_per_s_per_volt}, open, std::move(bench));
}

}  // namespace twin::hal::rig::testing

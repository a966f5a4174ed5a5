#pragma once

#include <memory>

#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/rig_machine.hpp"

namespace twin::test {

/// The rig over emulated cards in lockstep; `bench` is shared with the test.
inline std::unique_ptr<hal::rig::RigMachine> make_emulated(
    const hal::mujoco::TableParams& table, std::shared_ptr<hal::rig::emulator::EmulatedRig> bench,
    const hal::rig::RigSettings& settings) {
  const hal::MachineInfo info = hal::mujoco::MujocoMachine(table).info();
  hal::rig::emulator::EmulatedRig& rig = *bench;
  const auto open = [&rig, settings] {
    return hal::rig::RegisterCards::open(
        std::make_unique<hal::rig::boards::EmulatedPci1716>(rig.boards().pci1716),
        std::make_unique<hal::rig::boards::EmulatedPci1784>(rig.boards().pci1784), settings);
  };
  return std::make_unique<hal::rig::RigMachine>(
      settings, hal::rig::TableScales{info.mm_per_count, info.mm_per_s_per_volt}, open,
      std::move(bench));
}

}  // namespace twin::test

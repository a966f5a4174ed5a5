#include "twin/machines.hpp"

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/rig/boards/emulated_pci1716.hpp"
#include "hal/rig/boards/emulated_pci1784.hpp"
#include "hal/rig/emulator/emulated_rig.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/rig_machine.hpp"
#include "library/inside.hpp"

namespace twin {
namespace {

hal::rig::TableScales scales_of_table(const hal::mujoco::TableParams& table) {
  hal::rig::TableScales scales;
  for (std::size_t axis = 0; axis < kServoAxes; ++axis) {
    scales.mm_per_count[axis] = table.axis[axis].encoder.mm_per_count;
    scales.mm_per_s_per_volt[axis] = table.axis[axis].mm_per_s_per_volt();
  }
  return scales;
}

}  // namespace

std::unique_ptr<Machine> make_table(const Settings& settings) {
  return std::make_unique<hal::mujoco::MujocoMachine>(Inside::of(settings).table);
}

std::unique_ptr<Machine> make_ideal() { return std::make_unique<hal::ideal::IdealMachine>(); }

std::unique_ptr<Machine> make_emulated_rig(const Settings& settings,
                                           const std::vector<std::string>& faults) {
  namespace rig = hal::rig;
  const config::MachineFile& machine = Inside::of(settings);
  std::vector<rig::emulator::Fault> list;
  list.reserve(faults.size());
  for (const std::string& fault : faults) {
    list.push_back(value_of(rig::emulator::parse_fault(fault)));
  }
  const auto bench =
      std::make_shared<rig::emulator::EmulatedRig>(machine.table, machine.rig, std::move(list));
  const auto open = [bench, cards = machine.rig] {
    rig::boards::BoardRegisters& boards = bench->boards();
    rig::boards::Pci1784Layout layout;
    layout.reset = static_cast<std::uint32_t>(cards.counter_reset_offset);
    return rig::RegisterCards::open(
        std::make_unique<rig::boards::EmulatedPci1716>(boards.pci1716),
        std::make_unique<rig::boards::EmulatedPci1784>(boards.pci1784, layout), cards);
  };
  return std::make_unique<rig::RigMachine>(machine.rig, scales_of_table(machine.table), open,
                                           bench);
}

}  // namespace twin

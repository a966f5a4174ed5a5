#include "twin/machines.hpp"

#include <utility>

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/rig_machine.hpp"
#include "library/inside.hpp"

namespace twin {
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
  rig::assemble::RigSetup setup;
  setup.table = machine.table;
  setup.wiring = machine.rig;
  setup.faults = std::move(list);
  return rig::assemble::make_emulated_rig(std::move(setup));
}

}  // namespace twin

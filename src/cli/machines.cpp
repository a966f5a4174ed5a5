#include "cli/machines.hpp"

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"

namespace twin::cli {

std::unique_ptr<hal::Machine> make_machine(const std::string& hal,
                                           const config::MachineFile& machine) {
  if (hal == "ideal") {
    return std::make_unique<hal::IdealMachine>();
  }
  return std::make_unique<hal::MujocoMachine>(machine.table);
}

}  // namespace twin::cli

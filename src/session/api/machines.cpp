#include "twin/machines.hpp"

#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "session/api/inside.hpp"

namespace twin {

std::unique_ptr<Machine> make_table(const Settings& settings) {
  return std::make_unique<hal::mujoco::MujocoMachine>(Inside::of(settings).table);
}

std::unique_ptr<Machine> make_ideal() { return std::make_unique<hal::ideal::IdealMachine>(); }

}  // namespace twin

#include "session/machine.hpp"

#include <fmt/format.h>

#include <utility>

#include "config/find_file.hpp"
#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"

namespace twin::session {

Expected<config::MachineFile> read_machine(const MachineSource& source) {
  TWIN_TRY(const std::filesystem::path file, config::find_machine(source.file));
  return config::read_machine_file(file, source.settings);
}

Expected<std::unique_ptr<hal::Machine>> make_simulated_machine(std::string_view name,
                                                               const config::MachineFile& machine) {
  if (name == "ideal") {
    return std::make_unique<hal::ideal::IdealMachine>();
  }
  if (name == "mujoco") {
    return std::make_unique<hal::mujoco::MujocoMachine>(machine.table);
  }
  return fail(ErrorCode::kUsage,
              fmt::format("there is no simulated machine {}: they are mujoco and ideal", name));
}

MakeMachine simulated_machine(std::string name) {
  return [name = std::move(name)](const config::MachineFile& machine, const std::string&) {
    return make_simulated_machine(name, machine);
  };
}

bool needs_consent(const hal::MachineInfo& machine, Consent consent) {
  return !machine.simulated && consent != Consent::kGiven;
}

}  // namespace twin::session

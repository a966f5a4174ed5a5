#include "cli/machines.hpp"

#include "cli/rig_machines.hpp"
#include "hal/ideal/ideal_machine.hpp"
#include "hal/mujoco/mujoco_machine.hpp"

namespace twin::cli {

std::unique_ptr<hal::Machine> make_machine(const std::string& hal,
                                           const config::MachineFile& machine) {
  if (hal == "ideal") {
    return std::make_unique<hal::ideal::IdealMachine>();
  }
  return std::make_unique<hal::mujoco::MujocoMachine>(machine.table);
}

Expected<std::unique_ptr<hal::Machine>> open_machine(const Options& options,
                                                     const config::MachineFile& machine,
                                                     const std::string& what) {
  if (options.hal != "rig") {
    if (options.rig != "auto" || !options.faults.empty() || !options.rig_log.empty()) {
      return fail(ErrorCode::kUsage,
                  "--rig, --fault and --rig-log are for --hal rig, and this is "
                  "--hal " +
                      options.hal);
    }
    return make_machine(options.hal, machine);
  }
  return open_rig(options, machine, what)
      .map([](std::unique_ptr<hal::rig::RigMachine> rig) -> std::unique_ptr<hal::Machine> {
        return rig;
      });
}

}  // namespace twin::cli

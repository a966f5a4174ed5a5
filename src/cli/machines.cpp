#include "cli/machines.hpp"

#include "cli/rig_machines.hpp"
#include "session/machine.hpp"

namespace twin::cli {

std::unique_ptr<hal::Machine> make_machine(const std::string& hal,
                                           const config::MachineFile& machine) {
  return *session::make_simulated_machine(hal, machine);
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

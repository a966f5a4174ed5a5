#include "cli/rig_machines.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>

#include "cli/confirmation.hpp"
#include "cli/rig_ports.hpp"
#include "core/atomic_file.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;

/// The guard stands beside the program.
std::filesystem::path guard_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "twin-guard";
}

/// What happened at the emulated boards, when all is over.
void write_event_log(rig::emulator::EmulatedRig& emulated, const std::filesystem::path& file) {
  if (auto written = write_whole_file(file, emulated.report()); !written) {
    fmt::print(stderr, "twin: {}\n", to_string(written.error()));
  }
}

}  // namespace

Expected<RigKind> find_rig(const Options& options, const config::MachineFile& machine) {
  return rig::assemble::find_rig(options.rig, machine.rig, shared_name(options));
}

rig::assemble::RigSetup setup_of(const Options& options, const config::MachineFile& machine) {
  return {.table = machine.table,
          .wiring = machine.rig,
          .heartbeat_timeout = machine.safety.heartbeat_timeout,
          .guard_program = {},
          .shared_name = shared_name(options),
          .faults = {},
          .at_end = {}};
}

Expected<std::unique_ptr<rig::RigMachine>> open_rig(const Options& options,
                                                    const config::MachineFile& machine,
                                                    const std::string& what) {
  TWIN_TRY(const RigKind kind, find_rig(options, machine));
  if (kind != RigKind::kEmulated && (!options.faults.empty() || !options.rig_log.empty())) {
    return fail(ErrorCode::kUsage,
                fmt::format("--fault and --rig-log are for --rig emulated, and this rig is: {}; an "
                            "emulator's process takes --fault by itself",
                            describe(kind)));
  }
  rig::assemble::RigSetup setup = setup_of(options, machine);
  if (kind != RigKind::kEmulated) {
    setup.guard_program = guard_program();
  }
  for (const std::string& text : options.faults) {
    TWIN_TRY(const rig::emulator::Fault fault, rig::emulator::parse_fault(text));
    setup.faults.push_back(fault);
  }
  if (!options.rig_log.empty()) {
    setup.at_end = [log = options.rig_log](rig::emulator::EmulatedRig& emulated) {
      write_event_log(emulated, log);
    };
  }
  TWIN_TRY(std::unique_ptr<rig::RigMachine> opened,
           rig::assemble::make_rig(kind, std::move(setup)));
  TWIN_CHECK(confirm_motion(opened->info(), options.i_know_it_moves, what));
  return opened;
}

hal::MachineInfo machine_info(const config::MachineFile& machine) {
  return rig::assemble::rig_info(machine.rig, machine.table);
}

}  // namespace twin::cli

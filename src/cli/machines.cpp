#include "cli/machines.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <utility>

#include "cli/terminal.hpp"
#include "config/find_file.hpp"
#include "core/atomic_file.hpp"
#include "core/this_program.hpp"
#include "hal/linuxcnc/linuxcnc_machine.hpp"
#include "hal/rig/assemble/make_rig.hpp"
#include "hal/rig/assemble/rig_ports.hpp"
#include "hal/rig/boards/shared_registers.hpp"
#include "session/machine.hpp"

namespace twin::cli {
namespace {

namespace rig = hal::rig;
using rig::assemble::RigKind;

/// Lets a real machine move only when the user knows it: with --i-know-it-moves, or with a word
/// typed at a terminal.
Expected<void> confirm_motion(const hal::MachineInfo& machine, session::Consent consent,
                              const std::string& purpose) {
  if (!session::needs_consent(machine, consent)) {
    return {};
  }
  if (isatty(STDIN_FILENO) != 1) {
    return fail(ErrorCode::kUsage, "machine '" + machine.name +
                                       "' is real and would move; say so with --i-know-it-moves, "
                                       "or start it at a terminal and confirm there");
  }
  print_out("This is a REAL machine. {} will move it. Type move to go on: ", purpose);
  static_cast<void>(finish_output());
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "move") {
    return fail(ErrorCode::kInterrupted, "not confirmed: nothing has moved");
  }
  return {};
}

/// Writes what happened at the emulated boards, when all is over.
void write_event_log(rig::emulator::EmulatedRig& emulated, const std::filesystem::path& file) {
  if (auto written = write_whole_file(file, emulated.report()); !written) {
    print_error(written.error());
  }
}

Expected<RigKind> find_rig(const RigArguments& arguments, const config::MachineFile& machine) {
  return rig::assemble::find_rig(arguments.which, machine.rig, shared_name(arguments));
}

/// What a rig is put together from, without guard, faults and log.
rig::assemble::RigSetup setup_of(const RigArguments& arguments,
                                 const config::MachineFile& machine) {
  return {.table = machine.table,
          .wiring = machine.rig,
          .heartbeat_timeout = machine.safety.heartbeat_timeout,
          .guard_program = {},
          .shared_name = shared_name(arguments),
          .faults = {},
          .at_end = {}};
}

/// The options of the rig are refused where they would be ignored.
Expected<void> check_rig_is_meant(const HalArguments& arguments) {
  const RigArguments& rig = arguments.rig;
  if (rig.which != "auto" || !rig.faults.empty() || !rig.log.empty() || !rig.name.empty()) {
    return fail(ErrorCode::kUsage,
                "--rig, --rig-name, --fault and --rig-log are for --hal rig, and this is --hal " +
                    arguments.name);
  }
  return {};
}

/// Words of a command line as it is quoted for a shell, without quotation marks.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  bool is_quoted = false;
  for (const char c : command) {
    if (c == '\'') {
      is_quoted = !is_quoted;
    } else if (c == ' ' && !is_quoted) {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace

Expected<std::vector<hal::mujoco::Change>> read_changes(const std::vector<std::string>& texts) {
  std::vector<hal::mujoco::Change> changes;
  for (const std::string& text : texts) {
    TWIN_TRY(const hal::mujoco::Change change, hal::mujoco::parse_change(text));
    changes.push_back(change);
  }
  return changes;
}

std::string shared_name(const RigArguments& arguments) {
  return arguments.name.empty() ? rig::boards::default_shared_name() : arguments.name;
}

std::unique_ptr<hal::Machine> make_linuxcnc_machine(const RigArguments& arguments,
                                                    const config::MachineFile& machine) {
  const hal::MachineInfo info = rig::assemble::rig_info(machine.rig, machine.table);
  return std::make_unique<hal::linuxcnc::LinuxCncMachine>(
      hal::linuxcnc::Scales{info.mm_per_count, info.mm_per_s_per_volt}, arguments.name);
}

namespace {

/// The machine behind LinuxCNC's HAL, which takes no faults and needs no guard: its component is one.
Expected<std::unique_ptr<hal::Machine>> open_linuxcnc(const RigArguments& arguments,
                                                      const config::MachineFile& machine,
                                                      const std::string& purpose) {
  if (!arguments.faults.empty() || !arguments.log.empty() || !arguments.changes.empty()) {
    return fail(
        ErrorCode::kUsage,
        "--fault, --change and --rig-log are for --rig emulated; behind LinuxCNC twin plant takes "
        "--fault and --change by itself");
  }
  auto made = make_linuxcnc_machine(arguments, machine);
  const auto consent =
      arguments.is_known_to_move ? session::Consent::kGiven : session::Consent::kNotAsked;
  TWIN_CHECK(confirm_motion(made->info(), consent, purpose));
  return made;
}

}  // namespace

Expected<std::unique_ptr<hal::Machine>> open_rig(const RigArguments& arguments,
                                                 const config::MachineFile& machine,
                                                 const std::string& purpose) {
  if (arguments.which == kLinuxCnc) {
    return open_linuxcnc(arguments, machine, purpose);
  }
  TWIN_TRY(const RigKind kind, find_rig(arguments, machine));
  if (kind != RigKind::kEmulated &&
      (!arguments.faults.empty() || !arguments.log.empty() || !arguments.changes.empty())) {
    return fail(
        ErrorCode::kUsage,
        fmt::format("--fault, --change and --rig-log are for --rig emulated, and this rig is: "
                    "{}; an emulator's process takes --fault and --change by itself",
                    describe(kind)));
  }
  rig::assemble::RigSetup setup = setup_of(arguments, machine);
  if (kind != RigKind::kEmulated) {
    setup.guard_program = program_beside("twin-guard");
  }
  for (const std::string& text : arguments.faults) {
    TWIN_TRY(const rig::emulator::Fault fault, rig::emulator::parse_fault(text));
    setup.faults.push_back(fault);
  }
  if (!arguments.log.empty()) {
    setup.at_end = [log = arguments.log](rig::emulator::EmulatedRig& emulated) {
      write_event_log(emulated, log);
    };
  }
  TWIN_TRY(std::unique_ptr<rig::RigMachine> opened,
           rig::assemble::make_rig(kind, std::move(setup)));
  const auto consent =
      arguments.is_known_to_move ? session::Consent::kGiven : session::Consent::kNotAsked;
  TWIN_CHECK(confirm_motion(opened->info(), consent, purpose));
  return opened;
}

Expected<RigToLookAt> open_to_look(const RigArguments& arguments, config::MachineFile machine) {
  RigToLookAt seen;
  TWIN_TRY(seen.kind, find_rig(arguments, machine));
  seen.settings = rig::assemble::wiring_to_look_with(seen.kind, machine.rig);
  TWIN_TRY(seen.ports,
           rig::assemble::open_to_look(seen.kind, setup_of(arguments, machine), machine.period));
  seen.machine = std::move(machine);
  return seen;
}

Expected<gcode::ProgramText> read_program(const std::string& name, const MachineArguments& machine,
                                          const std::atomic<bool>& stop,
                                          const std::filesystem::path& out) {
  TWIN_TRY(const std::filesystem::path file, config::find_program(name));
  return gcode::ProgramText::read(
      file, {.folder = out, .stop = &stop, .subprogram_folders = machine.subprogram_folders});
}

Expected<config::MachineFile> read_machine(const MachineArguments& arguments, Verbosity verbosity) {
  session::MachineSource source{arguments.file, arguments.settings};
  if (!arguments.curves.empty()) {
    source.settings.push_back("path.curves=" + arguments.curves);
  }
  if (!arguments.dialect.empty()) {
    source.settings.push_back("program.dialect=" + arguments.dialect);
  }
  if (!arguments.ignored_axes.empty()) {
    source.settings.push_back("program.ignored_axes=" + arguments.ignored_axes);
  }
  if (!arguments.offset_mm.empty()) {
    source.settings.push_back("program.workpiece_mm=[" + arguments.offset_mm + "]");
  }
  if (!arguments.tool_table.empty()) {
    source.settings.push_back("program.tool_table=" + arguments.tool_table);
  }
  TWIN_TRY(config::MachineFile machine, session::read_machine(source));
  if (verbosity == Verbosity::kQuiet) {
    return machine;
  }
  if (arguments.has_old_name_of_curves) {
    print_note("--interpolator is the old name of --curves");
  }
  for (const std::string& note : machine.notes) {
    print_note(note);
  }
  return machine;
}

session::MakeMachine machine_of(const HalArguments& arguments,
                                const std::vector<std::string>& plant) {
  return [arguments, plant](const config::MachineFile& given,
                            const std::string& purpose) -> Expected<std::unique_ptr<hal::Machine>> {
    config::MachineFile machine = given;
    TWIN_CHECK(config::apply_overrides(machine, plant));
    TWIN_TRY(machine.table.changes, read_changes(arguments.rig.changes));
    if (arguments.name == "rig") {
      return open_rig(arguments.rig, machine, purpose);
    }
    if (arguments.name == kLinuxCnc) {
      return open_linuxcnc(arguments.rig, machine, purpose);
    }
    TWIN_CHECK(check_rig_is_meant(arguments));
    if (arguments.name == "ideal" && !machine.table.changes.empty()) {
      return fail(ErrorCode::kUsage,
                  "--change is for the simulated table, and this is --hal ideal");
    }
    return session::make_simulated_machine(arguments.name, machine);
  };
}

std::optional<gcode::ProgramText> program_of(const session::TraceOrigin& origin,
                                             const std::atomic<bool>& stop) {
  std::vector<std::string> names{origin.program};
  for (const std::string& word : words_of(origin.command)) {
    const std::filesystem::path file(word);
    if (file.filename() == origin.program || file.stem() == origin.program) {
      names.push_back(word);
    }
  }
  for (const std::string& name : names) {
    auto program = read_program(name, {}, stop);
    if (program && program->sha256() == origin.program_sha256) {
      return *std::move(program);
    }
  }
  return std::nullopt;
}

hal::Axis axis_of(const std::string& name) { return name == "x" ? hal::kX : hal::kY; }

}  // namespace twin::cli

#include "cli/machines.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <utility>

#include "cli/rig_machines.hpp"

namespace twin::cli {
namespace {

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
  fmt::print("This is a REAL machine. {} will move it. Type move to go on: ", purpose);
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  if (answer != "move") {
    return fail(ErrorCode::kInterrupted, "not confirmed: nothing has moved");
  }
  return {};
}

/// The options of the rig are refused where they would be ignored.
Expected<void> check_rig_is_meant(const HalArguments& arguments) {
  const RigArguments& rig = arguments.rig;
  if (rig.which != "auto" || !rig.faults.empty() || !rig.log.empty()) {
    return fail(
        ErrorCode::kUsage,
        "--rig, --fault and --rig-log are for --hal rig, and this is --hal " + arguments.name);
  }
  return {};
}

}  // namespace

Expected<config::MachineFile> read_machine(const MachineArguments& arguments, Verbosity verbosity) {
  session::MachineSource source{arguments.file, arguments.settings};
  if (!arguments.curves.empty()) {
    source.settings.push_back("path.curves=" + arguments.curves);
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

session::MakeMachine machine_of(const HalArguments& arguments) {
  return [arguments](const config::MachineFile& machine,
                     const std::string& purpose) -> Expected<std::unique_ptr<hal::Machine>> {
    if (arguments.name == "rig") {
      return open_rig(arguments.rig, machine, purpose);
    }
    TWIN_CHECK(check_rig_is_meant(arguments));
    return session::make_simulated_machine(arguments.name, machine);
  };
}

Expected<std::unique_ptr<hal::rig::RigMachine>> open_rig(const RigArguments& arguments,
                                                         const config::MachineFile& machine,
                                                         const std::string& purpose) {
  TWIN_TRY(std::unique_ptr<hal::rig::RigMachine> rig, assemble_rig(arguments, machine));
  const auto consent =
      arguments.is_known_to_move ? session::Consent::kGiven : session::Consent::kNotAsked;
  TWIN_CHECK(confirm_motion(rig->info(), consent, purpose));
  return rig;
}

hal::Axis axis_of(const std::string& name) { return name == "x" ? hal::kX : hal::kY; }

}  // namespace twin::cli

#include "cli/machines.hpp"

#include <memory>

#include "cli/rigs.hpp"

namespace twin::cli {
namespace {

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

hal::Axis axis_of(const std::string& name) { return name == "x" ? hal::kX : hal::kY; }

}  // namespace twin::cli

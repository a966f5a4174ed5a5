#include <fmt/core.h>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "runtime/program_check.hpp"

namespace twin::cli {
namespace {

Expected<void> check_program_of(const std::string& name, const CheckArguments& arguments,
                                const config::MachineFile& machine, const std::atomic<bool>& stop) {
  TWIN_TRY(const auto program, config::find_program(name));
  gcode::ReaderOptions reading;
  reading.feedrate = arguments.feedrate;
  TWIN_TRY(const runtime::Estimate estimate,
           runtime::estimate_program(program, reading, machine, &stop));
  if (arguments.verbosity == Verbosity::kNormal) {
    const runtime::ProgramFigures& figures = estimate.program;
    fmt::print(
        "{}: {} blocks, {:.3f} mm, X {:g} .. {:g}, Y {:g} .. {:g}, Z {:g} .. {:g} mm, "
        "cycle time {:.3f} s\n",
        program.string(), figures.blocks, figures.length, figures.box_min.x(), figures.box_max.x(),
        figures.box_min.y(), figures.box_max.y(), figures.box_min.z(), figures.box_max.z(),
        estimate.plan.time);
  }
  return {};
}

}  // namespace

/// Checks all the programs, so that one call shows what is wrong with each.
Expected<void> execute(const CheckArguments& arguments, const Environment& environment) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  Expected<void> result;
  for (const std::string& name : arguments.programs) {
    if (auto checked = check_program_of(name, arguments, machine, environment.stop); !checked) {
      if (!result) {
        print_error(result.error());
      }
      result = checked;
    }
  }
  return result;
}

}  // namespace twin::cli

#include <fmt/core.h>

#include "cli/commands.hpp"
#include "config/find_file.hpp"
#include "runtime/program_check.hpp"

namespace twin::cli {
namespace {

Expected<void> check_one(const std::string& name, const config::MachineFile& machine,
                         const Options& options, const std::atomic<bool>& stop) {
  auto program = config::find_program(name);
  if (!program) {
    return tl::unexpected(program.error());
  }
  gcode::ReaderOptions reading;
  reading.feedrate = feedrate_of(options);
  TWIN_TRY(const runtime::Estimate estimate,
           runtime::estimate_program(*program, reading, machine, &stop));
  if (!options.quiet) {
    const runtime::ProgramFigures& figures = estimate.program;
    fmt::print(
        "{}: {} blocks, {:.3f} mm, X {:g} .. {:g}, Y {:g} .. {:g}, Z {:g} .. {:g} mm, "
        "cycle time {:.3f} s\n",
        program->string(), figures.blocks, figures.length, figures.box_min.x(), figures.box_max.x(),
        figures.box_min.y(), figures.box_max.y(), figures.box_min.z(), figures.box_max.z(),
        estimate.plan.time);
  }
  return {};
}

/// Checks all the programs, so that one call shows what is wrong with each.
Expected<void> check_command(const Options& options, const std::atomic<bool>& stop) {
  auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  Expected<void> result;
  for (const std::string& name : options.programs) {
    if (auto checked = check_one(name, *machine, options, stop); !checked) {
      if (!result) {
        fmt::print(stderr, "twin: {}\n", to_string(result.error()));
      }
      result = checked;
    }
  }
  return result;
}

}  // namespace

Command add_check(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "check", "Read and verify programs and estimate their cycle time; nothing moves");
  app->add_option("programs", options.programs, "NC programs: files, or names in nc_programs")
      ->required()
      ->type_name("PROGRAM.nc ...");
  add_feedrate_option(*app, options);
  add_machine_options(*app, options);
  app->add_flag("--quiet", options.quiet, "Print errors only");
  return {app, [&options, &stop = context.stop] { return check_command(options, stop); }};
}

}  // namespace twin::cli

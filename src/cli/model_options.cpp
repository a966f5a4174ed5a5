#include <CLI/CLI.hpp>

#include "cli/option_groups.hpp"
#include "cli/options.hpp"

// Options of the commands that ask the identified model before or after a run: compensate, shadow, fastest.
namespace twin::cli {

void add_options(CLI::App& command, CompensateArguments& compensate) {
  command.footer(
      "Examples:\n"
      "  twin compensate dolphin.nc --out dolphin.csv\n"
      "  twin run dolphin.nc --compensate dolphin.csv");
  add_program(command, compensate.program);
  add_machine(command, compensate.machine);
  add_reading(command, compensate.machine);
  command.add_option("--out", compensate.file, "File to write [renders/PROGRAM/correction.csv]")
      ->type_name("FILE.csv");
  add_quiet(command, compensate.verbosity);
}

void add_options(CLI::App& command, ShadowCommandArguments& shadow) {
  command.footer(
      "Examples:\n"
      "  twin shadow --learn renders/*/trace.csv --out healthy.json\n"
      "  twin shadow renders/dolphin/trace.csv --learnt healthy.json\n"
      "  twin run dolphin.nc --shadow healthy.json");
  command.add_option("traces", shadow.traces, "trace.csv or trace.h5 of runs, or other recordings")
      ->required()
      ->type_name("TRACE...");
  command.add_flag("--learn", shadow.is_learning,
                   "These runs are healthy: learn what they are like");
  command
      .add_option(
          "--learnt", shadow.learnt,
          "What --learn has written; without it the shadow knows the model and [uncertainty]")
      ->type_name("FILE.json");
  command
      .add_option("--out", shadow.file,
                  "File to write [shadow.json beside the trace; renders/shadow/learnt.json]")
      ->type_name("FILE.json");
  command
      .add_option("--columns", shadow.columns,
                  "Columns of other recordings, as twin identify takes them")
      ->type_name("SIGNAL=COLUMN[:UNIT],...");
  add_machine(command, shadow.machine);
  add_quiet(command, shadow.verbosity);
}

void add_options(CLI::App& command, FastestArguments& fastest) {
  command.footer(
      "Examples:\n"
      "  twin fastest dolphin.nc --tolerance-um 25\n"
      "  twin run renders/dolphin/fastest.nc");
  add_program_name(command, fastest.program);
  add_tolerance(command, "--tolerance-um", "Contour error that 95 % of possible tables keep",
                [&fastest](double tolerance) { fastest.tolerance = tolerance; })
      ->required();
  add_machine(command, fastest.machine);
  add_reading(command, fastest.machine);
  command.add_option("--out", fastest.file, "Program to write [renders/PROGRAM/fastest.nc]")
      ->type_name("FILE.nc");
  add_quiet(command, fastest.verbosity);
}

}  // namespace twin::cli

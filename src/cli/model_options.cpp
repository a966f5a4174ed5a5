#include <CLI/CLI.hpp>

#include "cli/option_groups.hpp"
#include "cli/options.hpp"

// Options of the commands that ask the identified model before a run: compensate, fastest.
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

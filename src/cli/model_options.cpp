#include <CLI/CLI.hpp>

#include "cli/option_groups.hpp"
#include "cli/options.hpp"

// Options of the commands that find the identified model, or ask it before or after a run: identify,
// compensate, shadow, fastest.
namespace twin::cli {

void add_options(CLI::App& command, IdentifyArguments& identify) {
  command
      .add_option("traces", identify.traces,
                  "Traces: trace.csv or trace.h5 of a run, or any CSV or HDF5 of time, command and "
                  "measured position")
      ->type_name("TRACE ...");
  command.add_flag("--tables", identify.has_tables,
                   "Fit Tables 4 and 5 of Wang and Yau's paper in place of traces");
  add_machine(command, identify.machine);
  command
      .add_option("--columns", identify.columns,
                  "Columns of foreign traces, as in t=time:ms,x_cmd=ref,x_meas=pos:um; signals t, "
                  "x_cmd, x_meas, x_V, x_force, x_torque, x_table (a scale on the table beside the "
                  "motor's encoder) and those of y; units s ms us, 2ms of a counter, m mm um, V mV "
                  "mm/s m/s rpm, N kN, N_m")
      ->type_name("SIGNAL=COLUMN[:UNIT],...");
  add_list(command, "--at-table", identify.at_table,
           "Traces of the same machine with the encoder at the table: with others, they tell the "
           "screw's stiffness and play")
      ->type_name("TRACE");
  add_list(command, "--validate", identify.validating,
           "Traces that are predicted and not fitted; without, the end of each trace is held out")
      ->type_name("TRACE");
  add_no_plots(command, identify.has_plots);
  command
      .add_option("--out", identify.file,
                  "Machine file to write; identify.json is put beside it "
                  "[renders/identify/identified.toml]")
      ->type_name("FILE.toml");
  add_list(command, "--fix", identify.fixed,
           "Keys that keep their value, as in table.x.output_delay_ms")
      ->delimiter(',')
      ->type_name("KEY,...");
  add_list(command, "--free", identify.freed,
           "Keys to fit though others would be taken first, as in table.x.moving_mass_kg")
      ->delimiter(',')
      ->type_name("KEY,...");
  command.add_option("--seed", identify.seed, "Of the global search; same seed, same result")
      ->capture_default_str();
  command
      .add_option("--evaluations", identify.evaluations,
                  "Simulations of the global search at most [1200 an axis; tables: 1700]")
      ->check(CLI::Range(0, 10000000))
      ->type_name("N");
  add_quiet(command, identify.verbosity, "Print errors and notes only");
}

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

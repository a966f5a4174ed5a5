#include "cli/identify_options.hpp"

namespace twin::cli {

CLI::App* add_identify_command(CLI::App& app, Options& options, IdentifyOptions& identify) {
  CLI::App* const command = app.add_subcommand(
      "identify", "Fit the machine's parameters to recorded traces, and say which are shown");
  command
      ->add_option("traces", identify.traces,
                   "Traces: trace.csv of a run, or any CSV of time, command and measured position")
      ->required()
      ->type_name("TRACE.csv ...");
  command
      ->add_option("--machine", options.machine,
                   "Machine file to start from; what is not identified keeps its values")
      ->type_name("FILE.toml")
      ->capture_default_str();
  command
      ->add_option("--set", options.settings,
                   "Change a setting of the machine file first (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->take_all()
      ->expected(1);
  command
      ->add_option("--columns", identify.columns,
                   "Columns of foreign traces, as in t=time:ms,x_cmd=ref,x_meas=pos:um; signals t, "
                   "x_cmd, x_meas, x_V, y_cmd, y_meas, y_V; units s ms us m mm um V mV")
      ->type_name("SIGNAL=COLUMN[:UNIT],...");
  command
      ->add_option("--out", options.out,
                   "Machine file to write; identify.json is put beside it "
                   "[renders/identify/identified.toml]")
      ->type_name("FILE.toml");
  command
      ->add_option("--fix", identify.fixed, "Keys that keep their value, as in table.x.screw_lead")
      ->delimiter(',')
      ->type_name("KEY,...")
      ->take_all()
      ->expected(1);
  command
      ->add_option("--free", identify.freed,
                   "Keys to fit though others would be taken first, as in table.x.moving_mass_kg")
      ->delimiter(',')
      ->type_name("KEY,...")
      ->take_all()
      ->expected(1);
  command->add_option("--seed", identify.seed, "Of the global search; same seed, same result")
      ->capture_default_str();
  command
      ->add_option("--evaluations", identify.evaluations,
                   "Simulations of the global search at most; 0: local search only")
      ->check(CLI::Range(0, 10000000))
      ->capture_default_str();
  command->add_flag("--quiet", options.quiet, "Print errors and notes only");
  return command;
}

}  // namespace twin::cli

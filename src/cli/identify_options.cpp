#include "cli/identify_options.hpp"

namespace twin::cli {

void add_identify_options(CLI::App& command, Options& options, IdentifyOptions& identify) {
  command
      .add_option("traces", identify.traces,
                  "Traces: trace.csv of a run, or any CSV of time, command and measured position")
      ->type_name("TRACE.csv ...");
  command.add_flag("--tables", identify.tables,
                   "Fit Tables 4 and 5 of Wang and Yau's paper in place of traces");
  add_machine_options(command, options);
  command
      .add_option("--columns", identify.columns,
                  "Columns of foreign traces, as in t=time:ms,x_cmd=ref,x_meas=pos:um; signals t, "
                  "x_cmd, x_meas, x_V, y_cmd, y_meas, y_V; units s ms us m mm um V mV")
      ->type_name("SIGNAL=COLUMN[:UNIT],...");
  command
      .add_option("--out", options.out,
                  "Machine file to write; identify.json is put beside it "
                  "[renders/identify/identified.toml]")
      ->type_name("FILE.toml");
  command
      .add_option("--fix", identify.fixed,
                  "Keys that keep their value, as in table.x.output_delay_ms")
      ->delimiter(',')
      ->type_name("KEY,...")
      ->take_all()
      ->expected(1);
  command
      .add_option("--free", identify.freed,
                  "Keys to fit though others would be taken first, as in table.x.moving_mass_kg")
      ->delimiter(',')
      ->type_name("KEY,...")
      ->take_all()
      ->expected(1);
  command.add_option("--seed", identify.seed, "Of the global search; same seed, same result")
      ->capture_default_str();
  command
      .add_option("--evaluations", identify.evaluations,
                  "Simulations of the global search at most [1200 an axis; tables: 1700]")
      ->check(CLI::Range(0, 10000000))
      ->type_name("N");
  command.add_flag("--quiet", options.quiet, "Print errors and notes only");
}

}  // namespace twin::cli

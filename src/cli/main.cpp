#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <exception>
#include <span>

#include "cli/commands.hpp"
#include "cli/identify_options.hpp"
#include "cli/usage.hpp"

namespace {

std::atomic<bool> stop_requested{false};

extern "C" void request_stop(int /*signal*/) { stop_requested.store(true); }

/// The first signal brakes on the path and keeps the results; a second one ends the process as
/// usual.
void watch_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    sigaction(signal, &action, nullptr);
  }
}

int report(const twin::Expected<void>& result) {
  if (result) {
    return 0;
  }
  fmt::print(stderr, "twin: {}\n", twin::to_string(result.error()));
  return twin::exit_status(result.error());
}

using twin::cli::Options;

/// The subcommands; one of them is parsed.
struct Commands {
  CLI::App* run = nullptr;
  CLI::App* plan = nullptr;
  CLI::App* circle = nullptr;
  CLI::App* check = nullptr;
  CLI::App* convert = nullptr;
  CLI::App* render = nullptr;
  CLI::App* compare = nullptr;
  CLI::App* reproduce = nullptr;
  CLI::App* identify = nullptr;
};

void add_run_and_plan(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const run = app.add_subcommand(
      "run", "Plan a program, move the machine along it, write the results, print the summary");
  twin::cli::add_planning_options(*run, options);
  twin::cli::add_result_options(*run, options);
  twin::cli::add_video_options(*run, options);
  twin::cli::add_hal_option(*run, options);
  run->add_flag("--realtime", options.realtime, "Keep to the wall clock");

  CLI::App* const plan =
      app.add_subcommand("plan", "The same without a machine: set points, planned time, limits");
  twin::cli::add_planning_options(*plan, options);
  twin::cli::add_result_options(*plan, options);
  commands.run = run;
  commands.plan = plan;
}

void add_circle(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const circle = app.add_subcommand(
      "circle", "Circular test after ISO 230-4: both senses, deviations, reversal spikes");
  circle->add_option("--radius-mm", options.radius_mm, "Radius of the circle about X0 Y0")
      ->type_name("R")
      ->capture_default_str();
  circle->add_option("--feedrate-mm-per-min", options.feedrate_mm_per_min, "Feedrate [3000]")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
  twin::cli::add_machine_options(*circle, options);
  twin::cli::add_hal_option(*circle, options);
  circle->add_option("--out", options.out, "Folder of the results [renders/circle]")
      ->type_name("DIR");
  circle->add_flag("--no-plots", options.no_plots, "Write no figure");
  circle->add_flag("--quiet", options.quiet, "Print errors only");
  commands.circle = circle;
}

void add_check_and_render(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const check = app.add_subcommand("check", "Read and verify programs; nothing moves");
  check->add_option("programs", options.programs, "NC programs: files, or names in nc_programs")
      ->required()
      ->type_name("PROGRAM.nc ...");
  check->add_option("--machine", options.machine, "Machine file whose travel and limits count")
      ->type_name("FILE.toml")
      ->capture_default_str();
  check->add_option("--set", options.settings, "Change a setting of the machine file (repeatable)")
      ->type_name("SECTION.KEY=VALUE")
      ->take_all()
      ->expected(1);
  check
      ->add_option("--feedrate-mm-per-min", options.feedrate_mm_per_min,
                   "Feedrate in place of the program's F words")
      ->check(CLI::Range(1e-3, 1e6))
      ->type_name("F");
  check->add_flag("--quiet", options.quiet, "Print errors only");

  CLI::App* render =
      app.add_subcommand("render", "Plots and video again, from the trace in a folder");
  render->add_option("directory", options.out, "Folder of an earlier run")
      ->required()
      ->type_name("DIR");
  render->add_option("--machine", options.machine, "Machine file whose model the video shows")
      ->type_name("FILE.toml")
      ->capture_default_str();
  render->add_flag("--no-plots", options.no_plots, "Write no figures");
  render->add_flag("--quiet", options.quiet, "Print errors only");
  twin::cli::add_video_options(*render, options);
  commands.check = check;
  commands.render = render;
}

void add_compare(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const compare = app.add_subcommand(
      "compare", "The interpolators side by side on one program; the parameter updates too");
  twin::cli::add_program_options(*compare, options);
  twin::cli::add_machine_file_options(*compare, options);
  twin::cli::add_hal_option(*compare, options);
  compare->add_option("--out", options.out, "Folder of the results [renders/PROGRAM_compare]")
      ->type_name("DIR");
  compare->add_flag("--no-plots", options.no_plots, "Write no figures");
  compare->add_flag("--quiet", options.quiet, "Print errors only");
  commands.compare = compare;
}

void add_reproduce(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const reproduce = app.add_subcommand(
      "reproduce", "Tables 1 to 5 and Figs. 12 to 19 of Wang and Yau's paper beside ours");
  twin::cli::add_machine_file_options(*reproduce, options);
  reproduce
      ->add_option("--repeats", options.repeats, "Runs a row with other encoder and hum phases")
      ->check(CLI::Range(0, 1000))
      ->type_name("N")
      ->capture_default_str();
  reproduce->add_option("--out", options.out, "Folder of the results [renders/reproduce]")
      ->type_name("DIR");
  reproduce->add_flag("--no-plots", options.no_plots, "Draw no figures");
  reproduce->add_flag("--quiet", options.quiet, "Print errors only");
  commands.reproduce = reproduce;
}

void add_convert(CLI::App& app, Options& options, Commands& commands) {
  CLI::App* const convert = app.add_subcommand(
      "convert", "Write a program as NURBS blocks of a control; runs of short blocks are fitted");
  twin::cli::add_convert_options(*convert, options);
  commands.convert = convert;
}

Commands add_commands(CLI::App& app, Options& options,
                      twin::cli::IdentifyOptions& identify_options) {
  Commands commands;
  add_run_and_plan(app, options, commands);
  add_circle(app, options, commands);
  add_check_and_render(app, options, commands);
  add_compare(app, options, commands);
  add_reproduce(app, options, commands);
  add_convert(app, options, commands);
  commands.identify = twin::cli::add_identify_command(app, options, identify_options);
  return commands;
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace twin::cli;
  CLI::App app(
      "twin: digital twin of a servo XY table and of the CNC controller that drives it.\n"
      "Start with: twin run dolphin.nc",
      "twin");
  app.set_version_flag("--version", "twin " TWIN_VERSION);
  app.require_subcommand(1);
  Options options;
  IdentifyOptions identify_options;

  const Commands commands = add_commands(app, options, identify_options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    const std::span<const char* const> arguments(argv, static_cast<std::size_t>(argc));
    fmt::print(stderr, "twin: {}\n", usage_error(app, error, arguments.subspan(1)));
    return 2;
  }
  watch_signals();
  if (commands.run->parsed()) {
    return report(run_command(options, stop_requested));
  }
  if (commands.plan->parsed()) {
    return report(plan_command(options, stop_requested));
  }
  if (commands.circle->parsed()) {
    return report(circle_command(options, stop_requested));
  }
  if (commands.check->parsed()) {
    return report(check_command(options));
  }
  if (commands.compare->parsed()) {
    return report(compare_command(options, stop_requested));
  }
  if (commands.reproduce->parsed()) {
    return report(reproduce_command(options, stop_requested));
  }
  if (commands.convert->parsed()) {
    return report(convert_command(options));
  }
  if (commands.identify->parsed()) {
    return report(identify_command(options, identify_options, stop_requested));
  }
  return report(render_command(options));
} catch (const std::exception& error) {
  fmt::print(stderr, "twin: {}\n", error.what());
  return 1;
}
